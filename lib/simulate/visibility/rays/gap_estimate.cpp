#include "simulate/visibility/rays/gap_estimate.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

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
    // extend to the greatest range within a tiny angle, so the new ray goes to where the plane
    // leaves the reach.
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
