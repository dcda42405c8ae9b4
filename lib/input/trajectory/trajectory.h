#pragma once

#include <cstddef>
#include <vector>

#include "core/pose.h"

namespace sonarsim {

struct TimedPose {
    double t_s = 0.0;
    Pose T_world_vehicle;
};

/// Poses in strictly increasing time.
using Trajectory = std::vector<TimedPose>;

/// The most poses that a resampled trajectory or a survey pattern may have.
inline constexpr std::size_t max_poses = 10'000'000;

/// Interpolates the attitude at constant angular rate along the shorter arc; `fraction` runs from 0
/// (`from`) to 1 (`to`). Both are unit quaternions. Half a turn takes either arc.
Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to,
                         double fraction);

/// The pose at time `t_s`: linear in position, slerp in attitude between the two nearest poses.
/// InputError if the trajectory is empty or does not reach that time.
TimedPose interpolate(const Trajectory& trajectory, double t_s);

/// Poses at t0 + k / rate_hz, k = 0, 1, ..., up to the time of the last pose, where t0 is the time
/// of the first. The last pose is included if it misses the grid by at most 1e-9 s plus the
/// rounding of its own time (0.8 us for times that count from 1970). InputError if the trajectory
/// is empty, if the rate is so high that times round to the same number, or if there are more than
/// `max_poses`. A rate of 0 leaves the poses as they are.
Trajectory resample(const Trajectory& trajectory, double rate_hz);

}  // namespace sonarsim
