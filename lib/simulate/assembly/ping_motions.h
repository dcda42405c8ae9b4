#pragma once

#include <span>

#include "input/mission/mission.h"
#include "input/trajectory/trajectory.h"
#include "simulate/ping/sonar.h"

namespace sonarsim {

/// Sets the motions of the sonars with moves_in_ping at each pose, by the poses before and after
/// it. InputError if such a sonar has a setting that supports only a sonar at rest.
void add_ping_motions(const Mission& mission, const Trajectory& trajectory,
                      std::span<Sonar> sonars);

}  // namespace sonarsim
