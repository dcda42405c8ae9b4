#pragma once

#include "simulate/visibility/rays/cast_ray.h"
#include "simulate/visibility/rays/sampling.h"

namespace sonarsim {

/// Estimate of the surface between two neighbouring rays of a column, from the planes that they
/// met.
struct GapEstimate {
    bool continuous = true;  ///< the surface continues between the rays
    float border = 0.5F;     ///< border of the two planes, as a share of the gap
    /// Extent in range, m, whose echo may differ from that of the two planes.
    float range_uncertainty_m = 0.0F;
    bool bends = false;  ///< the surface continues and bends by more than five degrees
};

/// The surface is continuous if the two planes are nearly one, or if they cross between the rays,
/// at an edge between two facets, which is found exactly. The range uncertainty is the extent in
/// range of the planes between the rays, weighted by the relative error of the cosine. If the
/// surface is interrupted, the range uncertainty is the whole extent that either plane could cover
/// before the other ray, up to `reach_m`, the greatest range of the view. The angle between the
/// rays must be small.
GapEstimate estimate_gap(const CastRay& a, const CastRay& b, const Sampling& sampling,
                         float reach_m);

/// The angle along the column of the ray that splits a gap between two neighbours.
float split_angle(const CastRay& a, const CastRay& b, float reach_m);

/// True if adjacent rays of two columns met surfaces that are not one plane of one material.
bool disagree(const CastRay& a, const CastRay& b, const Sampling& sampling, float reach_m);

}  // namespace sonarsim
