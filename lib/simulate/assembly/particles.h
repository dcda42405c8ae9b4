#pragma once

#include <span>

#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "input/trajectory/trajectory.h"
#include "simulate/ping/sonar.h"

namespace sonarsim {

/// Draws the targets of scene.particles by the mission's seed, adds their instances, classes and
/// materials to the scene, and gives them to the sonars, each with the cross-sections at its
/// frequency. InputError for the names of other instances and for too many targets.
void add_particles(const Mission& mission, const Trajectory& trajectory, Scene& scene,
                   std::span<Sonar> sonars);

}  // namespace sonarsim
