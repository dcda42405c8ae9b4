#pragma once

#include <Eigen/Core>
#include <vector>

#include "run/preview/drawing.h"
#include "simulate/assembly/assemble.h"
#include "simulate/ping/sonar.h"
#include "simulate/visibility/engine.h"

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

/// A mission at one pose of its trajectory.
struct Moment {
    const Assembly& assembly;
    const VisibilityEngine& engine;  ///< the scene at that time
    std::uint32_t pose;
    std::vector<BeamOutline> beams;  ///< one per sonar
};

/// The height (world z) of the highest surface below the vehicle in each pixel of a plot of the
/// world's x and y, row by row from the top; NaN where there is no surface.
std::vector<float> heights_below(const VisibilityEngine& engine, const Eigen::Vector3d& vehicle,
                                 const PlaneFrame& frame);

/// Draws a plan, north (y) up: the height of the highest surface below the vehicle, dark where
/// there is none, the trajectory, the footprints of the sonars and the boxes and names of objects.
Picture draw_plan(const Moment& moment, int width, int height);

}  // namespace sonarsim
