#include <algorithm>
#include <cmath>

#include "simulate/visibility/rays/ray_columns.h"

namespace sonarsim {

namespace {

constexpr double widest_column = 0.0088;  // rad, of azimuth
constexpr double widest_strip = 0.035;    // rad, of elevation

constexpr double min_fan_rays = 8.0;     // along a column
constexpr double max_low_columns = 2.0;  // factor on the columns of a low fan

// The echo of a surface is proportional to the cosine, so the relative error of the cosine counts.
// Surface with a smaller cosine than this is too dark to matter.
constexpr float min_cosine = 0.02F;

// Two planes tangent to a smooth surface meet half way. The error of each is half of the change in
// cosine between them there, and a quarter of it on average.
constexpr float mean_cosine_error = 0.25F;

// Cosine of five degrees: the specular reflections of such surface diverge.
constexpr float cosine_of_bend = 0.9962F;

// Relative error of a product of a height and a cosine: a few roundings of a float.
constexpr float rounding = 1e-6F;

/// Two rays, and the cosine of each at the other's plane.
struct Neighbours {
    const CastRay& a;
    const CastRay& b;
    float cosine_ab;  ///< b's ray at a's plane
    float cosine_ba;
};

Neighbours neighbours(const CastRay& a, const CastRay& b) {
    return {a, b, -a.normal.dot(b.direction), -b.normal.dot(a.direction)};
}

bool in_reach(const CastRay& ray, float reach_m) {
    return !ray.missed() && ray.range_m < reach_m;
}

/// Metres of range that the ray's plane could cover from this ray to one that meets the plane at
/// `cosine`; a cosine of 0 or less means that the other ray misses the plane.
float range_covered_m(const CastRay& ray, float cosine, float reach_m) {
    if (ray.missed()) return 0.0F;
    const float there = ray.height_m < reach_m * cosine ? ray.height_m / cosine : reach_m;
    return std::fabs(there - std::min(ray.range_m, reach_m));
}

/// True if each plane predicts the other ray's range. Both rays have met something.
bool nearly_one_plane(const Neighbours& pair, float tolerance_m) {
    const auto& [a, b, cosine_ab, cosine_ba] = pair;
    return cosine_ab > 0.0F && cosine_ba > 0.0F &&
           std::fabs(a.height_m - b.range_m * cosine_ab) <= tolerance_m * cosine_ab &&
           std::fabs(b.height_m - a.range_m * cosine_ba) <= tolerance_m * cosine_ba;
}

float relative_change(float one, float other) {
    return std::fabs(one - other) / std::max({one, other, min_cosine});
}

}  // namespace

Sampling sampling_for(const View& view) {
    // Fitted to the speed-against-error report: over a rough floor every goal is just met if the
    // number of rays follows the goal, and the range uncertainty of a gap its power of 3/2.
    const double scale = view.relative_l1 / 0.03;
    const double density = 1.0 / std::sqrt(scale);
    const auto rays = [&](double count, double min_count) {
        return static_cast<int>(std::clamp(std::ceil(count * density), min_count, 4096.0));
    };
    Sampling sampling;
    switch (view.shape) {
        case ViewShape::fan: {
            // The error of a fan falls with the spacing of its rays in elevation and in azimuth, so
            // a beam wider than the usual half degree gets more than one column.
            sampling.columns = static_cast<int>(
                std::clamp(std::ceil(view.azimuth_rad / view.beams / widest_column), 1.0, 64.0));
            const double wanted = 0.75 * density * view.elevation_rad * view.beams *
                                  sampling.columns / view.azimuth_rad;
            sampling.rays = rays(wanted, min_fan_rays);
            // A low fan has more rays along a column than its density asks for. Where energies add,
            // it gets as many more columns: the ground bends within a beam.
            if (view.energies_add) {
                sampling.columns *= static_cast<int>(std::clamp(
                    std::round(sampling.rays / (wanted * density)), 1.0, max_low_columns));
            }
            // The nearest and the farthest surface of a beam often lie on the edges of the view,
            // several bins away from the surface that a ray half a step inside meets.
            sampling.inset = 0.0F;
            break;
        }
        case ViewShape::port_starboard:
            // A side is one row of bins, so other beams do not average out its errors: it gets one
            // ray per bin, and a few columns for the shapes of shadows.
            sampling.columns = rays(std::max(4.0, view.elevation_rad / widest_strip), 2.0);
            sampling.rays = rays(1.0 * view.range_bins, 64.0);
            break;
        case ViewShape::cone:
            // A cone is one row of bins, where a small object may be alone in its bin.
            sampling.columns = rays(view.energies_add ? 192.0 : 96.0, 8.0);
            sampling.rays = rays(view.energies_add ? 50.0 : 36.0, 4.0);
            break;
    }
    // An edge strip shows whether a bin has any surface; a sum of energies needs its area.
    sampling.edge_strips = !view.energies_add;
    const double uncertainty = 0.2 * std::clamp(scale * std::sqrt(scale), 0.03, 30.0);  // bins
    sampling.range_uncertainty_m = static_cast<float>(uncertainty * view.bin_m());
    const auto slack = static_cast<float>(std::clamp(scale, 0.1, 2.0));
    sampling.tolerance_m = 0.2F * slack * static_cast<float>(view.bin_m());
    sampling.tolerance_cosine = 0.1F * slack;
    // An energy is spread over at most 128 bins (equation/patches.h); in narrow windows over less.
    if (view.energies_add)
        sampling.longest_m =
            static_cast<float>(std::max(100.0 * view.bin_m(), 0.002 * view.range_max_m));
    return sampling;
}

GapEstimate estimate_gap(const CastRay& a, const CastRay& b, const Sampling& sampling,
                         float reach_m) {
    if (!in_reach(a, reach_m) && !in_reach(b, reach_m)) return {};
    if (a.facet == b.facet) return {};
    const Neighbours pair = neighbours(a, b);
    const float cosine_ab = pair.cosine_ab;
    const float cosine_ba = pair.cosine_ba;
    const auto broken_off = [&]() -> GapEstimate {
        return {.continuous = false,
                .range_uncertainty_m = std::max(range_covered_m(a, cosine_ab, reach_m),
                                                range_covered_m(b, cosine_ba, reach_m))};
    };
    if (a.missed() || b.missed()) return broken_off();
    const bool same_material = a.material == b.material;
    // `covered_m`: the extent in range of the two planes between the rays.
    const auto continuous = [&](float border, float covered_m) -> GapEstimate {
        const float cosine_error =
            same_material ? mean_cosine_error * std::max(relative_change(a.cosine, cosine_ba),
                                                         relative_change(b.cosine, cosine_ab))
                          : 1.0F;
        return {.continuous = true,
                .border = border,
                .range_uncertainty_m = cosine_error * covered_m,
                .bends = a.normal.dot(b.normal) < cosine_of_bend};
    };
    // In a direction with cosines c_a and c_b at the planes, plane a is the nearer one if h_a c_b <
    // h_b c_a. Cosines are nearly linear in the small angle between the rays. If the order of the
    // planes differs between the two rays, the planes cross in the gap.
    const float at_a = a.height_m * cosine_ba - b.height_m * a.cosine;
    const float at_b = a.height_m * b.cosine - b.height_m * cosine_ab;
    if ((at_a < 0.0F) != (at_b < 0.0F) &&
        std::fabs(at_a - at_b) > rounding * (a.height_m + b.height_m)) {
        const float border = at_a / (at_a - at_b);
        const float cosine_a = a.cosine + border * (cosine_ab - a.cosine);
        const float cosine_b = cosine_ba + border * (b.cosine - cosine_ba);
        if (cosine_a > 0.0F && cosine_b > 0.0F) {
            return continuous(border, range_covered_m(a, cosine_a, reach_m) +
                                          range_covered_m(b, cosine_b, reach_m));
        }
    }
    if (same_material && nearly_one_plane(pair, sampling.tolerance_m)) {
        return continuous(0.5F,
                          std::fabs(std::min(b.range_m, reach_m) - std::min(a.range_m, reach_m)));
    }
    return broken_off();
}

float split_angle(const CastRay& a, const CastRay& b, float reach_m) {
    const float middle = 0.5F * (a.along + b.along);
    if (in_reach(a, reach_m) == in_reach(b, reach_m)) return middle;
    // One ray met a surface within reach, the other did not. At grazing incidence that surface may
    // extend to the greatest range within a tiny angle, so the new ray goes to that place.
    const CastRay& near = in_reach(a, reach_m) ? a : b;
    const CastRay& other = in_reach(a, reach_m) ? b : a;
    const float cosine_leaving = near.height_m / (reach_m * (1.0F + 0.5F * overreach));
    const float cosine_other = -near.normal.dot(other.direction);
    const float share = (near.cosine - cosine_leaving) / (near.cosine - cosine_other);
    // A ray closer to `a` or `b` than this share of the gap would only repeat that ray.
    constexpr float min_share = 0.01F;
    return cosine_other < cosine_leaving && share > min_share && share < 1.0F - min_share
               ? near.along + share * (other.along - near.along)
               : middle;
}

bool disagree(const CastRay& a, const CastRay& b, const Sampling& sampling, float reach_m) {
    if (!in_reach(a, reach_m) && !in_reach(b, reach_m)) return false;
    if (a.missed() || b.missed()) return true;
    if (a.facet == b.facet) return false;
    const Neighbours pair = neighbours(a, b);
    return a.material != b.material || !nearly_one_plane(pair, sampling.tolerance_m) ||
           std::fabs(pair.cosine_ab - b.cosine) >
               sampling.tolerance_cosine * std::max(b.cosine, min_cosine);
}

}  // namespace sonarsim
