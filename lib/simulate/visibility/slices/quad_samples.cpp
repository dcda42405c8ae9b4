#include "simulate/visibility/slices/quad_samples.h"

#include <algorithm>
#include <cmath>

#include "simulate/visibility/slices/parallelogram.h"

namespace sonarsim {

namespace {

// Largest number of parts across a patch.
constexpr float max_parts = 8.0F;

// Surface at a smaller cosine to the line of sight is grazing: it dims a bin by its area alone.
constexpr float grazing_cosine = 0.1F;

// Towards the line in which all slices meet, a patch is divided into narrower ones down to this
// share of its width. The rest has a four-hundredth of the area.
constexpr float min_width_share = 0.05F;

// A parallelogram is as wide at its far end as at its near end; the surface is not. So a patch may
// extend from one range to at most this many times that range.
constexpr float longest_ratio = 1.5F;

RangeLine range_line(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    RangeLine line;
    line.from = from;
    line.length = (to - from).norm();
    line.along = line.length > 0.0F ? Eigen::Vector3f((to - from) / line.length) : from;
    line.s0 = from.dot(line.along);
    line.s1 = line.s0 + line.length;
    line.h2 = std::max(from.squaredNorm() - line.s0 * line.s0, 0.0F);
    const float nearest = line.s0 > 0.0F ? line.s0 : line.s1 < 0.0F ? -line.s1 : 0.0F;
    line.near2 = line.h2 + nearest * nearest;
    line.far2 = line.h2 + std::max(line.s0 * line.s0, line.s1 * line.s1);
    return line;
}

}  // namespace

QuadSampler::QuadSampler(const FrameScan& scan, const PatchLimits& limits, std::vector<Sample>& out)
    : scan_(scan),
      limits_(limits),
      any_width_(!scan.frame().meridians || limits.widest_ratio == unbounded),
      out_(out),
      R_sensor_frame_(scan.frame().R_frame_sensor.transpose()) {}

void QuadSampler::add(const Quad& quad) {
    const QuadPoints corners = quad.corners();
    if (any_width_ && is_small(corners)) {
        divide_across(quad, corners);
    } else {
        cut_along(quad);
    }
}

/// True if cut_along() would not cut the quadrilateral. The foot of the perpendicular is not
/// farther than the nearest point, h <= r, which is at least 0.9 of the nearest corner.
bool QuadSampler::is_small(const QuadPoints& corners) const {
    const float nearest = corners.range.minCoeff();
    const float length2 = (corners.middle(2, 3) - corners.middle(0, 1)).squaredNorm();
    return corners.range.maxCoeff() <= limits_.range_max_m &&
           length2 <= std::min(7.0F * limits_.sag_m * nearest, 0.01F * nearest * nearest);
}

/// Cuts a quadrilateral along w into parts whose range bends little.
void QuadSampler::cut_along(const Quad& quad) {
    const float u = 0.5F * (quad.low.u + quad.high.u);
    const float w_low = quad.middle_low();
    const float w_high = quad.middle_high();
    const QuadPoints ends = quad.points({u, u, u, u}, {w_low, w_high, w_low, w_high});
    const RangeLine line = range_line(ends.at(0), ends.at(1));
    const float reach2 = limits_.range_max_m * limits_.range_max_m;
    if (line.near2 > reach2) return;
    const auto sag = [&](float step, float range2) {
        return step * step * line.h2 <= 8.0F * limits_.sag_m * range2 * std::sqrt(range2);
    };
    if (line.length <= limits_.shortest_m ||
        (sag(line.length, line.near2) && line.far2 <= longest_ratio * longest_ratio * line.near2 &&
         line.far2 <= reach2)) {
        cut_narrow(quad, 0.0F, 1.0F);
        return;
    }
    find_cuts(line);
    // Converts positions along the line to shares of the way between the borders.
    const float per_w = 1.0F / (w_high - w_low);
    const auto share = [&](float s) {
        const Eigen::Vector3f p = line.from + (s - line.s0) * line.along;
        return std::clamp((p.z() / p.x() - w_low) * per_w, 0.0F, 1.0F);
    };
    float last = share(cuts_.front());
    for (std::size_t i = 1; i < cuts_.size(); ++i) {
        const float next = share(cuts_[i]);
        if (next > last) cut_narrow(quad, last, next);
        last = next;
    }
}

/// Fills `cuts_` with positions along the line, so that the range bends little between two of them:
/// steps outward from the nearest point, then in order.
void QuadSampler::find_cuts(const RangeLine& line) {
    const float reach2 = limits_.range_max_m * limits_.range_max_m;
    const float reach = std::sqrt(std::max(reach2 - line.h2, 0.0F)) + limits_.shortest_m;
    const auto outward = [&](float begin, float end) {
        end = std::min(end, reach);
        for (float s = begin; s < end;) {
            const float range2 = line.h2 + s * s;
            const float range = std::sqrt(range2);
            const float bend = std::sqrt(8.0F * limits_.sag_m * range2 * range / line.h2);
            const float step =
                std::max(std::min(bend, (longest_ratio - 1.0F) * range), limits_.shortest_m);
            s = s + 1.25F * step < end ? s + step : end;
            cuts_.push_back(s);
        }
    };
    cuts_.clear();
    if (line.s0 < 0.0F) {
        outward(std::max(-line.s1, 0.0F), -line.s0);
        std::ranges::reverse(cuts_);
        for (float& s : cuts_)
            s = -s;
    }
    cuts_.push_back(std::clamp(0.0F, line.s0, line.s1));
    if (line.s1 > 0.0F) outward(std::max(line.s0, 0.0F), line.s1);
}

/// Cuts the part of a quadrilateral between two shares of the way along w into patches with similar
/// widths at both ends.
void QuadSampler::cut_narrow(const Quad& quad, float from, float to) {
    if (any_width_) {
        add_part(quad, from, to);
        return;
    }
    // Between two meridians the width is proportional to X, and 1 / X is linear in w.
    const float u = 0.5F * (quad.low.u + quad.high.u);
    const auto X_at = [&](float share) {
        const float w = quad.middle_low() + share * (quad.middle_high() - quad.middle_low());
        return quad.points({u, u, u, u}, {w, w, w, w}).X[0];
    };
    const float X_from = X_at(from);
    const float X_to = X_at(to);
    const bool narrows = X_to < X_from;
    const float widest = std::max(X_from, X_to);
    const float narrowest = std::max(std::min(X_from, X_to), min_width_share * widest);
    const float per_share = (1.0F / X_to - 1.0F / X_from) / (to - from);
    float last = narrows ? from : to;
    if (widest == unbounded) return;
    float X = widest / limits_.widest_ratio;
    while (X > narrowest) {
        const float next = std::clamp(from + (1.0F / X - 1.0F / X_from) / per_share, from, to);
        if (next != last) add_part(quad, std::min(last, next), std::max(last, next));
        last = next;
        X /= limits_.widest_ratio;
    }
    const float end = narrows ? to : from;
    if (end != last) add_part(quad, std::min(last, end), std::max(last, end));
}

/// Adds the part of a quadrilateral between two shares of the way along w.
void QuadSampler::add_part(const Quad& quad, float from, float to) {
    const auto part = [&](const QuadSide& side) -> QuadSide {
        const float width = side.high - side.low;
        return {side.u, side.low + from * width, side.low + to * width};
    };
    Quad out = quad;
    out.low = part(quad.low);
    out.high = part(quad.high);
    divide_across(out, out.corners());
}

/// Divides a quadrilateral of long, grazing surface across into equal parts, since its ranges are
/// not those of a parallelogram.
void QuadSampler::divide_across(const Quad& quad, const QuadPoints& corners) {
    if (limits_.long_grazing_m == unbounded) return push(quad, corners);
    const Eigen::Array4f& r = corners.range;
    const float farthest = r.maxCoeff();
    const bool is_long = farthest - r.minCoeff() > limits_.long_grazing_m;
    const float wedge = std::fabs(std::fabs(r[3] - r[0]) - std::fabs(r[2] - r[1]));
    if (!is_long || !(quad.height_m < grazing_cosine * farthest)) return push(quad, corners);
    const float parts = std::clamp(std::ceil(wedge / limits_.grazing_wedge_m), 1.0F, max_parts);
    Quad part = quad;
    for (int i = 1; i <= static_cast<int>(parts); ++i) {
        const float share = static_cast<float>(i) / parts;
        const auto between = [&](float x, float y) { return x + share * (y - x); };
        part.high = {between(quad.low.u, quad.high.u), between(quad.low.low, quad.high.low),
                     between(quad.low.high, quad.high.high)};
        push(part, part.corners());
        part.low = part.high;
    }
}

/// Adds the sample of a quadrilateral.
void QuadSampler::push(const Quad& quad, const QuadPoints& corners) {
    const Parallelogram patch = fit_parallelogram(quad, corners, R_sensor_frame_, !any_width_);
    if (!(patch.area_m2 > 0.0F)) return;
    const FrontFacet& front = scan_.scene().facets[quad.facet_index];
    const SliceFacet& facet = scan_.mesh().facets[front.facet];
    out_.push_back({.position = patch.position,
                    .edge_u = patch.edge_u,
                    .edge_v = patch.edge_v,
                    .normal = R_sensor_frame_ * front.normal,
                    .height_m = front.height_m,
                    .area_m2 = patch.area_m2,
                    .material = facet.material,
                    .instance = facet.instance});
}

}  // namespace sonarsim
