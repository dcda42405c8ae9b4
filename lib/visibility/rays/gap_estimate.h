#pragma once

#include "visibility/rays/cast_ray.h"
#include "visibility/rays/sampling.h"

namespace sonarsim {

/// What is known of the surface between two neighbouring rays of a column, from the planes that
/// they met.
struct GapEstimate {
    bool continuous = true;  ///< the surface continues from the one to the other
    float border = 0.5F;     ///< where the one plane gives way to the other, as a share of the gap
    float range_uncertainty_m = 0.0F;  ///< metres of range that may echo unlike the two planes
    bool bends = false;                ///< it continues, and bends by more than five degrees
};

/// The surface is continuous where the two planes are nearly one, or where they cross between the
/// rays: an edge between two facets, which is then found exactly. The range uncertainty is the
/// part of the planes that lies between the rays, weighted by the relative error of its cosine.
/// Where the surface breaks off it is all that either plane could cover before the other ray, up to
/// `reach_m`, the greatest range that echoes. The angle between the rays must be small.
GapEstimate estimate_gap(const CastRay& a, const CastRay& b, const Sampling& sampling,
                         float reach_m);

/// The angle along the column of the ray that splits the gap between two neighbours.
float split_angle(const CastRay& a, const CastRay& b, float reach_m);

/// Whether rays side by side in two columns met surfaces that are not one plane of one material.
bool disagree(const CastRay& a, const CastRay& b, const Sampling& sampling, float reach_m);

}  // namespace sonarsim
