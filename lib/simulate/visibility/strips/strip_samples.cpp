#include "simulate/visibility/strips/strip_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

using Eigen::Vector3f;

constexpr float max_parts_by_wedge = 8.0F;
constexpr float max_parts_across = 32.0F;
constexpr float max_parts_along = 64.0F;

// An edge that spans less than this many bins may taper.
constexpr float taper_bins = 1.5F;

// If the borders at both sides leave less than this share of the length at the middle, they cross
// within the strip, and the strip is as long as at its middle.
constexpr float crossing_share = 0.7F;

// Lengths that differ by less than this share are equal.
constexpr float same_length = 1e-3F;

constexpr float min_length = 1e-30F;

// A sample is at most so long, so that what is looked up at its middle holds for all of it.
constexpr float max_sample_bins = 24.0F;

/// The number of parts of a line whose range bends by `sag_m`.
float parts_by_sag(float sag_m, float max_sag_m) {
    return sag_m > max_sag_m ? std::ceil(std::sqrt(sag_m / max_sag_m)) : 1.0F;
}

}  // namespace

StripSamples::StripSamples(const ClustersInView& clusters, const ColumnFrame& frame,
                           const StripRule& rule, const ColumnPieces& pieces,
                           std::vector<Sample>& out)
    : clusters_(clusters),
      frame_(frame),
      rule_(rule),
      pieces_(pieces),
      R_sensor_frame_(frame.R_frame_sensor.transpose()),
      R_sensor_local_(clusters.pose.rotation.transpose()),
      out_(out) {}

Vector3f StripSamples::point(const Strip& strip, float u, float w) const {
    const float q =
        std::clamp(pieces_.q_at(strip.piece, u, w), strip.triangle.q_min, strip.triangle.q_max);
    const float X = 1.0F / q;
    return {X, X * u, X * w};
}

/// A strip ends where one of its lower borders, hidden or own, meets one of its upper ones.
std::pair<float, float> StripSamples::ends(const Strip& strip) const {
    const VisibleInterval& v = strip.visible;
    const PieceEnd own_low = pieces_.low(strip.piece, strip.middle);
    const PieceEnd own_high = pieces_.high(strip.piece, strip.middle);
    float from = strip.from;
    float to = strip.to;
    for (const PieceEnd low : {PieceEnd{v.low, v.low_slope}, own_low}) {
        for (const PieceEnd high : {PieceEnd{v.high, v.high_slope}, own_high}) {
            const float opening = high.slope - low.slope;
            const float crossing = strip.middle - (high.w - low.w) / opening;
            if (opening > 0.0F) from = std::max(from, crossing);
            if (opening < 0.0F) to = std::min(to, crossing);
        }
    }
    return {std::min(from, strip.middle), std::max(to, strip.middle)};
}

void StripSamples::add(const Strip& strip) {
    const VisibleInterval& v = strip.visible;
    const auto side = [&](float u) {
        float low = v.low + v.low_slope * (u - strip.middle);
        float high = v.high + v.high_slope * (u - strip.middle);
        float min_w = pieces_.low(strip.piece, u).w;
        float max_w = pieces_.high(strip.piece, u).w;
        if (!frame_.surely_sees(u, u, min_w, max_w)) {
            const ColumnLimits view = frame_.limits_at(u);
            min_w = std::max(min_w, view.low);
            max_w = std::min(max_w, view.high);
        }
        low = std::max(min_w, std::min(max_w, low));
        high = std::max(min_w, std::min(max_w, high));
        if (high < low) low = high = 0.5F * (low + high);
        return std::pair(low, high);
    };
    auto [from, to] = ends(strip);
    auto [near_low, near_high] = side(from);
    auto [far_low, far_high] = side(to);
    float lengths = near_high - near_low + far_high - far_low;
    const float length = v.high - v.low;
    if (lengths < crossing_share * length) {
        near_low = far_low = v.low;
        near_high = far_high = v.high;
        lengths = 2.0F * length;
        from = 0.5F * (from + strip.middle);
        to = 0.5F * (to + strip.middle);
    }
    Quad quad{point(strip, from, near_low), point(strip, from, near_high),
              point(strip, to, far_low), point(strip, to, far_high), 0.0F};
    quad.area_m2 =
        0.5F * (quad.far_high - quad.near_low).cross(quad.near_high - quad.far_low).norm();
    if (to - from < strip.to - strip.from) quad.area_m2 *= (strip.to - strip.from) / (to - from);
    // The area is the whole width times the length at the middle, which is right on average
    // wherever borders end within the piece. On a line u = const lengths are as dw / (q q').
    const float low = 0.5F * (near_low + far_low);
    const float high = 0.5F * (near_high + far_high);
    if (std::fabs(0.5F * lengths - length) > same_length * length) {
        const auto q = [&](float w) { return 1.0F / point(strip, strip.middle, w).x(); };
        quad.area_m2 *= length * q(low) * q(high) / (0.5F * lengths * q(v.low) * q(v.high));
    }
    if (quad.area_m2 > 0.0F) add_quad(strip.triangle, quad);
}

/// The number of parts of equal shares of u.
int StripSamples::parts_across(const Quad& quad, const Ranges& r) const {
    const float wedge =
        std::fabs(std::fabs(r.near_high - r.near_low) - std::fabs(r.far_high - r.far_low));
    float parts = 1.0F;
    if (wedge > rule_.wedge_m)
        parts = std::min(std::ceil(wedge / rule_.wedge_m), max_parts_by_wedge);
    const float near = 0.5F * (r.near_low + r.near_high);
    const float far = 0.5F * (r.far_low + r.far_high);
    const float across = std::fabs(far - near);
    if (across > taper_bins * rule_.bin_m) {
        const float a = (quad.near_high - quad.near_low).norm();
        const float b = (quad.far_high - quad.far_low).norm();
        parts = std::max(parts, std::ceil(std::fabs(b - a) / ((a + b + min_length) * rule_.taper)));
    }
    if (across > 0.5F * rule_.bin_m) {
        const Vector3f middle =
            0.25F * (quad.near_low + quad.near_high + quad.far_low + quad.far_high);
        parts = std::max(parts, parts_by_sag(0.5F * (near + far) - middle.norm(), rule_.sag_m));
    }
    return static_cast<int>(std::min(parts, max_parts_across));
}

void StripSamples::add_quad(const StripTriangle& triangle, const Quad& quad) {
    const Ranges r{quad.near_low.norm(), quad.near_high.norm(), quad.far_low.norm(),
                   quad.far_high.norm()};
    const float nearest = std::min({r.near_low, r.near_high, r.far_low, r.far_high});
    // The range of an edge of length l bends by at most l^2 / (8 r).
    const float longest2 = std::max((quad.near_high - quad.near_low).squaredNorm(),
                                    (quad.far_high - quad.far_low).squaredNorm());
    const float end = rule_.range_max_m + 2.0F * rule_.bin_m;
    if (nearest > end &&
        nearest - end >
            std::sqrt(std::max(longest2, (quad.far_high - quad.near_low).squaredNorm())))
        return;
    const int parts = parts_across(quad, r);
    const float depth = 0.5F * std::fabs(r.near_high + r.far_high - r.near_low - r.far_low);
    const float in_beam = rule_.along_rad * nearest;
    const bool is_short = longest2 < 7.0F * rule_.sag_m * nearest &&
                          depth < taper_bins * rule_.bin_m && longest2 < in_beam * in_beam;
    if (parts == 1) return cut_along(triangle, quad, is_short);
    const float a = (quad.near_high - quad.near_low).norm();
    const float b = (quad.far_high - quad.far_low).norm();
    const Vector3f low = quad.far_low - quad.near_low;
    const Vector3f high = quad.far_high - quad.near_high;
    for (int k = 0; k < parts; ++k) {
        const float from = static_cast<float>(k) / static_cast<float>(parts);
        const float to = static_cast<float>(k + 1) / static_cast<float>(parts);
        const float share = (to - from) * (2.0F * a + (b - a) * (from + to)) / (a + b + min_length);
        cut_along(triangle,
                  {quad.near_low + from * low, quad.near_high + from * high,
                   quad.near_low + to * low, quad.near_high + to * high, quad.area_m2 * share},
                  is_short);
    }
}

/// The number of parts along w, and the widths of both sides square to the cut.
int StripSamples::parts_along(const Quad& quad, float& low_width, float& high_width) const {
    const Vector3f low = 0.5F * (quad.near_low + quad.far_low);
    const Vector3f high = 0.5F * (quad.near_high + quad.far_high);
    const Vector3f along = high - low;
    const float r_low = low.norm();
    const float r_high = high.norm();
    low_width = (quad.far_low - quad.near_low).cross(along).norm();
    high_width = (quad.far_high - quad.near_high).cross(along).norm();
    float parts = parts_by_sag(0.5F * (r_low + r_high) - (0.5F * (low + high)).norm(), rule_.sag_m);
    const float depth = std::fabs(r_high - r_low);
    parts = std::max(parts, std::ceil(depth / (max_sample_bins * rule_.bin_m)));
    const float sine = low.cross(high).norm() / (r_low * r_high + min_length);
    parts = std::max(parts, std::ceil(sine / rule_.along_rad));
    if (depth > taper_bins * rule_.bin_m)
        parts = std::max(parts, std::ceil(std::fabs(high_width - low_width) /
                                          ((low_width + high_width + min_length) * rule_.taper)));
    return static_cast<int>(std::min(parts, max_parts_along));
}

/// The part of a quadrilateral within the range, by its middle line; out of range the area is 0.
StripSamples::Quad StripSamples::within_range(const Quad& quad) const {
    const Vector3f low = 0.5F * (quad.near_low + quad.far_low);
    const Vector3f high = 0.5F * (quad.near_high + quad.far_high);
    const float end = rule_.range_max_m + 2.0F * rule_.bin_m;
    if (std::max(low.squaredNorm(), high.squaredNorm()) <= end * end) return quad;
    const Vector3f along = high - low;
    const float length2 = along.squaredNorm();
    const float middle = -low.dot(along);
    const float root2 = middle * middle - length2 * (low.squaredNorm() - end * end);
    const float root = std::sqrt(std::max(root2, 0.0F));
    const float from = std::max((middle - root) / length2, 0.0F);
    const float to = std::min((middle + root) / length2, 1.0F);
    if (!(to > from)) return {};
    const float low_width = (quad.far_low - quad.near_low).cross(along).norm();
    const float high_width = (quad.far_high - quad.near_high).cross(along).norm();
    const float share = (to - from) * (2.0F * low_width + (high_width - low_width) * (from + to)) /
                        (low_width + high_width + min_length);
    const Vector3f near = quad.near_high - quad.near_low;
    const Vector3f far = quad.far_high - quad.far_low;
    return {quad.near_low + from * near, quad.near_low + to * near, quad.far_low + from * far,
            quad.far_low + to * far, quad.area_m2 * share};
}

/// Cuts a quadrilateral along w into parallelograms whose range bends little, with similar widths.
void StripSamples::cut_along(const StripTriangle& triangle, const Quad& whole, bool one_part) {
    const Quad quad = within_range(whole);
    if (!(quad.area_m2 > 0.0F)) return;
    float low_width = 1.0F;
    float high_width = 1.0F;
    const int count = one_part ? 1 : parts_along(quad, low_width, high_width);
    const float widths = low_width + high_width;
    const float share = 1.0F / static_cast<float>(count);
    // The centroid lies towards the longer side.
    const float near_length = (quad.near_high - quad.near_low).norm();
    const float far_length = (quad.far_high - quad.far_low).norm();
    const float shift =
        (far_length - near_length) / (3.0F * (near_length + far_length) + min_length);
    const Vector3f low = R_sensor_frame_ * (0.5F * (quad.near_low + quad.far_low));
    const Vector3f along = R_sensor_frame_ * (0.5F * (quad.near_high + quad.far_high)) - low;
    const Vector3f low_half = R_sensor_frame_ * (0.5F * (quad.far_low - quad.near_low));
    const Vector3f high_half = R_sensor_frame_ * (0.5F * (quad.far_high - quad.near_high));
    const ClusterFacet& facet = clusters_.facet(triangle.facet);
    const Vector3f normal = triangle.side * (R_sensor_local_ * facet.normal);
    for (int k = 0; k < count; ++k) {
        const float at = (static_cast<float>(k) + 0.5F) * share;
        const Vector3f half = low_half + at * (high_half - low_half);
        const float width =
            widths > 0.0F ? 2.0F * (low_width + (high_width - low_width) * at) / widths : 1.0F;
        out_.push_back({.position = low + at * along + shift * half,
                        .edge_u = half,
                        .edge_v = 0.5F * share * along,
                        .normal = normal,
                        .height_m = triangle.height_m,
                        .area_m2 = quad.area_m2 * share * width,
                        .material = facet.material,
                        .instance = facet.instance,
                        .wedge = 3.0F * shift});
    }
}

}  // namespace sonarsim
