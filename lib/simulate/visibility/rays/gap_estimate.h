#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/rays/sampling.h"

namespace sonarsim {

/// A ray of a column and the plane of the facet that it met, in the sensor frame.
struct CastRay {
    static constexpr int none = -1;

    Eigen::Vector3f direction;
    float along;                                       ///< angle along the column, rad
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< distance of the sensor from the plane
    float cosine = 0.0F;                               ///< cosine of the angle of incidence
    float range_m = 0.0F;
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    int next = none;         ///< index of the next ray along the column
    bool continuous = true;  ///< the surface probably continues to the next ray
    float border = 0.5F;     ///< end of this ray's segment, as a share of the angle to the next

    bool missed() const { return facet == Caster::nothing; }
};

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
