#pragma once

#include "core/units.h"
#include "visibility/engine.h"

namespace sonarsim::test {

/// A patch of 20 x 20 cm with a normal that faces the sonar.
inline Sample patch_with(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                         std::uint32_t instance = 0) {
    return {.position = position,
            .edge_u = {0.0F, 0.1F, 0.0F},
            .edge_v = {0.0F, 0.0F, 0.1F},
            .normal = normal,
            .height_m = -normal.dot(position),
            .area_m2 = 0.04F,
            .material = 0,
            .instance = instance};
}

/// A fan of 90 by 20 degrees that sees particles up to 50 m away.
inline View fan_of_50_m() {
    return {.azimuth_rad = radians(90.0),
            .elevation_rad = radians(20.0),
            .range_min_m = 0.5,
            .range_max_m = 50.0,
            .range_bins = 100,
            .beams = 32,
            .relative_l1 = 0.03,
            .shape = ViewShape::fan};
}

}  // namespace sonarsim::test
