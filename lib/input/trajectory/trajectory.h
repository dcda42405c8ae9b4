#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
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

/// Reads poses from a file of at most 64 MiB: CSV if its name ends in .csv, TUM if it ends in .txt
/// or .tum. InputError for any other name, and for what the two readers below refuse.
Trajectory read_trajectory(const std::filesystem::path& file);

/// Reads poses from CSV text. The header names, in any order, t_s, x_m, y_m, z_m and either qx, qy,
/// qz, qw or roll_deg, pitch_deg, yaw_deg (rotation_from_rpy), and nothing else. `file` is for
/// messages. InputError with file:line for a faulty header, a field that is not a finite number or
/// is implausibly large, a quaternion whose norm is off by more than 1e-3 (within that it is
/// normalised), times that do not increase strictly, and if there is no pose.
Trajectory parse_csv_trajectory(std::string_view text, const std::string& file);

/// Reads poses from TUM text: lines of `t x y z qx qy qz qw` in seconds and metres, separated by
/// blanks; '#' starts a comment. InputError with file:line:column as for CSV.
Trajectory parse_tum(std::string_view text, const std::string& file);

/// Writes poses as TUM text below the names of the columns; parse_tum reads the same numbers.
std::string write_tum(const Trajectory& trajectory);

}  // namespace sonarsim
