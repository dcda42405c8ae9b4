#pragma once

#include <span>

#include "input/mission/trajectory_keys.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

struct Waypoint {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();          ///< world
    Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< unit; vehicle to world
};

/// Straight legs from waypoint to waypoint at constant speed, from time 0, with a pose every 1 /
/// rate_hz s. The attitude turns from one waypoint's to the next one's along the whole leg; a
/// waypoint in between decides the direction of a half turn. One waypoint gives one pose.
/// InputError for a leg without length, which has no speed (move the waypoint, or turn along a
/// leg), and for what resample() refuses.
Trajectory follow_waypoints(std::span<const Waypoint> waypoints, double speed_m_s, double rate_hz);

/// A lawnmower pattern over the rectangle at constant height and speed. The rectangle is cut along
/// the heading into the fewest strips of width line_spacing_m that cover it with equal margins. A
/// line runs along the middle of each strip, bow ahead, over the part of the strip that meets the
/// rectangle. The first line is the furthest to starboard; each next line lies to port of the one
/// before. At the end of a line the vehicle moves straight to the start of the next while it turns
/// through the port side of the first line's heading. InputError if there are more than 100,000
/// lines or more poses than max_poses.
Trajectory lawnmower(const LawnmowerTrajectoryConfig& survey);

}  // namespace sonarsim
