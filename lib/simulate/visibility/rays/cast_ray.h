#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulate/visibility/caster.h"

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

}  // namespace sonarsim
