#pragma once

#include <Eigen/Core>
#include <vector>

#include "ping/sonar.h"
#include "product/picture.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The outline of a sonar's view: the end points of rays along its edge, on a surface or at the
/// largest range.
struct BeamOutline {
    Eigen::Vector3d origin;             ///< position of the sonar, world
    std::vector<Eigen::Vector3d> ends;  ///< end points once around, world
    Rgb colour;
};

BeamOutline beam_outline(const Sonar& sonar, const VisibilityEngine& engine,
                         const Pose& T_world_sensor, Rgb colour);

}  // namespace sonarsim
