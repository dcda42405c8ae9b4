#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/assemble.h"
#include "ping/sonar.h"
#include "preview/labels.h"
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

/// A mission at one pose of its trajectory.
struct Moment {
    const Assembly& assembly;
    std::uint32_t pose;
    std::vector<BeamOutline> beams;  ///< one per sonar
};

/// Height by width of what draw_plan() shows.
double plan_shape(const Moment& moment);

/// Height by width of what draw_section() shows.
double section_shape(const Moment& moment, bool across);

/// Draws a plan, north (y) up: the height of the highest surface below the vehicle, dark where
/// there is none, the trajectory, the footprints of the sonars and the boxes and names of objects.
Drawing draw_plan(const Moment& moment, int width, int height);

/// Draws a section along or across the vehicle's heading: the surface in the vertical plane through
/// the vehicle, and the beams of all sonars seen from the side. The horizontal axis counts from the
/// vehicle, ahead or to starboard; the vertical axis is world z. The drawing is lower than
/// `most_height` if the beams need less.
Drawing draw_section(const Moment& moment, bool across, int width, int most_height);

}  // namespace sonarsim
