#pragma once

#include "mission/trajectory_config.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// The poses that a mission asks for. InputError for what is wrong with their file or numbers.
Trajectory poses_of(const TrajectoryConfig& config);

}  // namespace sonarsim
