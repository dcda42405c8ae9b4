#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Sets the motions of the sonars with moves_in_ping at each pose, by the poses before and after
/// it. InputError if such a sonar has a setting that supports only a sonar at rest.
void add_ping_motions(const Mission& mission, const Trajectory& trajectory,
                      std::span<Sonar> sonars);

/// The coherent echo of smooth faces supports only a sonar at rest: removes it from sonars that
/// move in a ping, and adds a warning to the scene.
void leave_out_glints(std::span<Sonar> sonars, Scene& scene);

}  // namespace sonarsim
