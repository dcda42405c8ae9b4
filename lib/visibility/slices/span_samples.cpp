#include "visibility/slices/span_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace sonarsim {

namespace {

// Of a range bin.
constexpr float most_sag = 0.03F;
constexpr float shortest_piece = 0.25F;
constexpr float most_excess = 0.15F;

// A plane beside the slice: where its q would fall below this share, it has run away to infinity.
constexpr float least_q_share = 1e-3F;

// Across a piece, at most.
constexpr float most_parts = 8.0F;

// A parallelogram is as wide at its far end as at its near end, which the surface is not. A piece
// may reach from one range to this many times that range.
constexpr float longest_ratio = 1.5F;

}  // namespace

PieceLimits piece_limits(const View& view) {
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto finer = static_cast<float>(std::clamp(view.relative_l1 / 0.03, 0.1, 1.0));
    const float of_bin = finer * bin_m;
    return {most_sag * of_bin, most_excess * of_bin, shortest_piece * of_bin,
            static_cast<float>(view.range_max_m)};
}

/// A visible span's surroundings in the picture plane: between two verticals and two borders.
struct SpanSampler::Quad {
    bool widens;
    QuadSide low, high;
    float u, w;  ///< of a point on the slice
    float q, q_u, q_w, q_least, nearest_m, farthest_m;
    const SeenFacet* seen;

    /// The point of the plane at `along` of the way between the borders of one side.
    Eigen::Vector3f corner(const QuadSide& side, float along) const {
        return point(side.u, side.low + along * (side.high - side.low));
    }

    float middle_low() const { return 0.5F * (low.low + high.low); }
    float middle_high() const { return 0.5F * (low.high + high.high); }

    Eigen::Vector3f point(float at_u, float at_w) const {
        if (widens) at_u *= std::sqrt(1.0F + at_w * at_w);
        const float X = 1.0F / std::max(q + q_u * (at_u - u) + q_w * (at_w - w), q_least);
        const float range = X * std::sqrt(1.0F + at_u * at_u + at_w * at_w);
        const float forward = X * (std::clamp(range, nearest_m, farthest_m) / range);
        return {forward, at_u * forward, at_w * forward};
    }
};

SpanSampler::SpanSampler(const FrameScan& scan, const PieceLimits& limits, std::vector<Sample>& out)
    : scan_(scan),
      limits_(limits),
      out_(out),
      R_sensor_frame_(scan.frame().R_frame_sensor.transpose()) {}

void SpanSampler::add(const Slice& slice, float u_low, float u_high,
                      std::span<const VisibleSpan> spans) {
    move_ends(slice, spans, u_low, low_);
    move_ends(slice, spans, u_high, high_);
    for (std::size_t i = 0; i < spans.size(); ++i)
        add_span(slice, spans[i], i);
}

/// The border of a span's quadrilateral on one side: at the side itself, or on the way to it where
/// the ends meet each other, or one of them the end that both follow.
SpanSampler::QuadSide SpanSampler::quad_side(const Slice& slice, const MovedEnds& side,
                                             std::size_t span) {
    const MovedEnd& low = side.ends[2 * span];
    const MovedEnd& high = side.ends[2 * span + 1];
    if (low.w < high.w || low.by != high.by) return {side.u, low.w, high.w};
    const MovedEnd& leader = side.ends[low.by];
    const bool from_below = low.by <= 2 * span;
    const float before =
        from_below ? high.at_slice - leader.at_slice : leader.at_slice - low.at_slice;
    const float after = from_below ? leader.w - high.alone : low.alone - leader.w;
    const float share = after > 0.0F ? before / (before + after) : 1.0F;
    const float w = leader.at_slice + share * (leader.w - leader.at_slice);
    return {slice.u + share * (side.u - slice.u), w, w};
}

void SpanSampler::add_span(const Slice& slice, const VisibleSpan& span, std::size_t index) {
    const SeenFacet& seen = scan_.scene().facets[span.seen];
    Quad quad;
    quad.seen = &seen;
    quad.widens = !scan_.frame().meridians;
    quad.u = slice.u;
    quad.w = span.q_low < span.q_high ? span.w_low : span.w_high;
    quad.q = std::min(span.q_low, span.q_high);
    quad.q_u = -seen.normal.y() / seen.height_m;
    quad.q_w = -seen.normal.z() / seen.height_m;
    // Beside the slice a plane may run away from the sensor, but its triangle does not.
    quad.q_least = least_q_share * quad.q;
    quad.nearest_m = span.reach.range_m.from;
    quad.farthest_m = span.reach.range_m.to;
    const QuadSide on_slice{slice.u, span.w_low, span.w_high};
    quad.low = quad_side(slice, low_, index);
    quad.high = quad_side(slice, high_, index);
    const auto keep = [&](QuadSide& side) {
        const float u = std::clamp(side.u, span.reach.u.from, span.reach.u.to);
        if (u == side.u) return;
        const float share = (u - slice.u) / (side.u - slice.u);
        side.low = span.w_low + share * (side.low - span.w_low);
        side.high = span.w_high + share * (side.high - span.w_high);
        side.u = u;
    };
    keep(quad.low);
    keep(quad.high);
    // Ends that bend at the slice make two quadrilaterals.
    const float share = (slice.u - quad.low.u) / (quad.high.u - quad.low.u);
    const auto bend = [&](float low, float at, float high) {
        return std::fabs(low + share * (high - low) - at);
    };
    const float most = 0.02F * (span.w_high - span.w_low);
    if (quad.low.u < slice.u && slice.u < quad.high.u &&
        (bend(quad.low.low, span.w_low, quad.high.low) > most ||
         bend(quad.low.high, span.w_high, quad.high.high) > most)) {
        const QuadSide high = std::exchange(quad.high, on_slice);
        cut(quad);
        quad.low = on_slice;
        quad.high = high;
    }
    cut(quad);
}

/// Cuts a quadrilateral along w into pieces that are nearly parallelograms.
void SpanSampler::cut(const Quad& quad) {
    const float u = 0.5F * (quad.low.u + quad.high.u);
    const float w_low = quad.middle_low();
    const float w_high = quad.middle_high();
    const Eigen::Vector3f from = quad.point(u, w_low);
    const Eigen::Vector3f to = quad.point(u, w_high);
    // Along the line from one to the other the range is sqrt(h^2 + s^2).
    const float length = (to - from).norm();
    const Eigen::Vector3f along = length > 0.0F ? Eigen::Vector3f((to - from) / length) : from;
    const float s0 = from.dot(along);
    const float s1 = s0 + length;
    const float h2 = std::max(from.squaredNorm() - s0 * s0, 0.0F);
    const float nearest = s0 > 0.0F ? s0 : s1 < 0.0F ? -s1 : 0.0F;
    const float reach2 = limits_.range_max_m * limits_.range_max_m;
    const float near2 = h2 + nearest * nearest;
    const float far2 = h2 + std::max(s0 * s0, s1 * s1);
    if (near2 > reach2) return;
    const auto sag = [&](float step, float range2) {
        return step * step * h2 <= 8.0F * limits_.sag_m * range2 * std::sqrt(range2);
    };
    if (length <= limits_.shortest_m ||
        (sag(length, near2) && far2 <= longest_ratio * longest_ratio * near2 && far2 <= reach2)) {
        add_piece(quad, 0.0F, 1.0F);
        return;
    }
    // Steps outward from the nearest point, then in order.
    const float reach = std::sqrt(std::max(reach2 - h2, 0.0F)) + limits_.shortest_m;
    const auto outward = [&](float begin, float end) {
        end = std::min(end, reach);
        for (float s = begin; s < end;) {
            const float range2 = h2 + s * s;
            const float range = std::sqrt(range2);
            const float bend = std::sqrt(8.0F * limits_.sag_m * range2 * range / h2);
            const float step =
                std::max(std::min(bend, (longest_ratio - 1.0F) * range), limits_.shortest_m);
            s = s + 1.25F * step < end ? s + step : end;
            cuts_.push_back(s);
        }
    };
    cuts_.clear();
    if (s0 < 0.0F) {
        outward(std::max(-s1, 0.0F), -s0);
        std::ranges::reverse(cuts_);
        for (float& s : cuts_)
            s = -s;
    }
    cuts_.push_back(std::clamp(0.0F, s0, s1));
    if (s1 > 0.0F) outward(std::max(s0, 0.0F), s1);
    // From places along the line to shares of the way between the borders.
    const float per_w = 1.0F / (w_high - w_low);
    const auto share = [&](float s) {
        const Eigen::Vector3f p = from + (s - s0) * along;
        return std::clamp((p.z() / p.x() - w_low) * per_w, 0.0F, 1.0F);
    };
    float last = share(cuts_.front());
    for (std::size_t i = 1; i < cuts_.size(); ++i) {
        const float next = share(cuts_[i]);
        if (next > last) add_piece(quad, last, next);
        last = next;
    }
}

/// Adds the part of a quadrilateral between two shares of the way along w. Where its range is not
/// that of a parallelogram, it is cut across.
void SpanSampler::add_piece(const Quad& quad, float from, float to) {
    const Eigen::Vector3f a = quad.corner(quad.low, from);
    const Eigen::Vector3f b = quad.corner(quad.high, from);
    const Eigen::Vector3f c = quad.corner(quad.high, to);
    const Eigen::Vector3f d = quad.corner(quad.low, to);
    const float r_a = a.norm();
    const float r_b = b.norm();
    const float r_c = c.norm();
    const float r_d = d.norm();
    const auto [least, most] = std::minmax({r_a, r_b, r_c, r_d});
    const float across = 0.5F * std::fabs(r_b + r_c - r_a - r_d);
    const float along = 0.5F * std::fabs(r_c + r_d - r_a - r_b);
    const float excess = across + along - (most - least);
    if (excess <= limits_.excess_m) {
        add_sample(quad, a, b, c, d);
        return;
    }
    const int parts = static_cast<int>(std::min(std::ceil(excess / limits_.excess_m), most_parts));
    Eigen::Vector3f low_from = a;
    Eigen::Vector3f low_to = d;
    for (int i = 1; i <= parts; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(parts);
        const auto between = [&](float x, float y) { return x + share * (y - x); };
        const QuadSide side{between(quad.low.u, quad.high.u), between(quad.low.low, quad.high.low),
                            between(quad.low.high, quad.high.high)};
        const Eigen::Vector3f high_from = quad.corner(side, from);
        const Eigen::Vector3f high_to = quad.corner(side, to);
        add_sample(quad, low_from, high_from, high_to, low_to);
        low_from = high_from;
        low_to = high_to;
    }
}

void SpanSampler::add_sample(const Quad& quad, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                             const Eigen::Vector3f& c, const Eigen::Vector3f& d) {
    const SliceFacet& facet = scan_.mesh().facets[quad.seen->facet];
    const float area = 0.5F * (c - a).cross(d - b).norm();
    if (!(area > 0.0F)) return;
    Sample& sample = out_.emplace_back();
    sample.position = R_sensor_frame_ * (0.25F * (a + b + c + d));
    sample.edge_u = R_sensor_frame_ * (0.25F * (b + c - a - d));
    sample.edge_v = R_sensor_frame_ * (0.25F * (c + d - a - b));
    sample.normal = R_sensor_frame_ * quad.seen->normal;
    sample.height_m = quad.seen->height_m;
    sample.area_m2 = area;
    sample.material = facet.material;
    sample.instance = facet.instance;
}

}  // namespace sonarsim
