#pragma once

#include <span>
#include <vector>

#include "mission/mission.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Where bodies that move are at a time of their trajectories.
std::vector<Pose> poses_at(std::span<const Trajectory> motions, double t_s);

/// The poses that a mission asks for. InputError for what is wrong with their file or numbers.
Trajectory poses_of(const TrajectoryConfig& config);

/// The poses of a mission's vehicle: those that it asks for, with `vehicle`, whose numbers may be
/// drawn for every ping.
Trajectory vehicle_poses(const Mission& mission);

}  // namespace sonarsim
