#pragma once

#include <span>

#include "core/random.h"
#include "input/mission/trajectory_keys.h"
#include "input/trajectory/trajectory.h"

// Poses that the mission's numbers describe, and what changes poses.

namespace sonarsim {

/// Straight legs from waypoint to waypoint (T_world_vehicle) at constant speed, from time 0, with a
/// pose every 1 / rate_hz s. The attitude turns from one waypoint's to the next one's along the
/// whole leg; a waypoint in between decides the direction of a half turn. One waypoint gives one
/// pose. InputError for a leg without length, which has no speed (move the waypoint, or turn along
/// a leg), and for what resample() refuses.
Trajectory follow_waypoints(std::span<const Pose> waypoints, double speed_m_s, double rate_hz);

/// A lawnmower pattern over the rectangle at constant height and speed. The rectangle is cut along
/// the heading into the fewest strips of width line_spacing_m that cover it with equal margins. A
/// line runs along the middle of each strip, bow ahead, over the part of the strip that meets the
/// rectangle. The first line is the furthest to starboard; each next line lies to port of the one
/// before. At the end of a line the vehicle moves straight to the start of the next while it turns
/// through the port side of the first line's heading. InputError if there are more than 100,000
/// lines or more poses than max_poses.
Trajectory lawnmower(const LawnmowerTrajectoryConfig& survey);

/// Adds the movements to every pose, in the vehicle's frame there. Each of the six is a sum of 64
/// cosines with random phases that share the energy of a Pierson-Moskowitz spectrum equally: S(f) ~
/// f^-5 exp(-1.25 (f_p / f)^4) with the peak f_p = 1 / period_s has the share u = exp(-1.25 (f_p /
/// f)^4) of its energy below f, so cosine k has f_k = f_p (1.25 / -ln u_k)^(1/4), u_k drawn in [k,
/// k + 1) / 64, and the amplitude sqrt(2 / 64) standard deviations. The six are independent.
void add_wave_motion(const MotionConfig& motion, PhiloxKey draws, Trajectory& poses);

/// The poses that the vehicle's instruments report: the true ones with the errors.
Trajectory reported_poses(const Trajectory& truth, const NavigationConfig& errors, PhiloxKey draws);

}  // namespace sonarsim
