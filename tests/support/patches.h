#pragma once

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

}  // namespace sonarsim::test
