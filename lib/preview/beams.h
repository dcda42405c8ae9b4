#pragma once

#include <Eigen/Core>
#include <vector>

#include "ping/sonar.h"
#include "product/picture.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The edge of what a sonar looks at: where rays along it end, on a surface or at the greatest
/// range.
struct BeamOutline {
    Eigen::Vector3d origin;             ///< the sonar, world
    std::vector<Eigen::Vector3d> ends;  ///< once around, world
    Rgb colour;
};

BeamOutline beam_outline(const Sonar& sonar, const VisibilityEngine& engine,
                         const Pose& T_world_sensor, Rgb colour);

}  // namespace sonarsim
