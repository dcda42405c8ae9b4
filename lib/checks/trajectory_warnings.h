#pragma once

#include <vector>

#include "checks/warning.h"
#include "mission/trajectory_config.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Doubts about attitudes: angles that look like radians, quaternions that look like w x y z.
std::vector<Warning> trajectory_warnings(const TrajectoryConfig& config,
                                         const Trajectory& trajectory);

}  // namespace sonarsim
