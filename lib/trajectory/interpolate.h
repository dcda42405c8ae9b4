#pragma once

#include <cstddef>

#include "trajectory/trajectory.h"

namespace sonarsim {

/// The most poses that a resampled trajectory or a survey pattern may have.
inline constexpr std::size_t most_poses = 10'000'000;

/// The attitude `fraction` (0 to 1) of the way from `from` to `to` at constant angular rate, along
/// the shorter arc. Both are unit quaternions. Half a turn has no shorter arc: which way round it
/// goes is then fixed, but not to be relied upon.
Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to,
                         double fraction);

/// The pose at time `t_s`: position linear, attitude by slerp between the neighbouring poses.
/// InputError when the trajectory is empty or does not reach to that time.
TimedPose interpolate(const Trajectory& trajectory, double t_s);

/// Poses at t0 + k / rate_hz, k = 0, 1, ..., up to the time of the last pose, t0 being that of the
/// first. The last pose is included when it misses the grid by no more than 1e-9 s plus the
/// rounding of its own time (0.8 us for times that count from 1970). InputError when the trajectory
/// is empty, the rate is not positive, is too high for the times to be told apart, or gives more
/// than `most_poses`.
Trajectory resample(const Trajectory& trajectory, double rate_hz);

}  // namespace sonarsim
