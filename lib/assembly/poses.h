#pragma once

#include <span>
#include <vector>

#include "mission/trajectory_config.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Where bodies that move are at a time of their trajectories.
std::vector<Pose> poses_at(std::span<const Trajectory> motions, double t_s);

/// The poses that a mission asks for. InputError for what is wrong with their file or numbers.
Trajectory poses_of(const TrajectoryConfig& config);

}  // namespace sonarsim
