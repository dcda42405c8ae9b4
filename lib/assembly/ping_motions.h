#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Gives the sonars with moves_in_ping their motion at each pose, by the poses before and after it,
/// and that of the scene's bodies, whose trajectories are `bodies`. InputError where such a sonar
/// has something that is made for one at rest.
void add_ping_motions(const Mission& mission, const Trajectory& trajectory, const Scene& scene,
                      std::span<const Trajectory> bodies, std::span<Sonar> sonars);

/// The coherent echo of smooth faces is made for a sonar at rest: takes it from those that move in
/// a ping, with a warning to the scene.
void leave_out_glints(std::span<Sonar> sonars, Scene& scene);

}  // namespace sonarsim
