#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "trajectory/trajectory.h"

namespace sonarsim {

/// Poses from a file of at most 64 MiB: CSV when its name ends in .csv, TUM when it ends in .txt
/// or .tum. InputError for any other name, and for what the two readers below refuse.
Trajectory read_trajectory(const std::filesystem::path& file);

/// Poses from CSV text. The header names, in any order, t_s, x_m, y_m, z_m and either qx, qy, qz,
/// qw or roll_deg, pitch_deg, yaw_deg (rotation_from_rpy), and nothing else. `file` is for the
/// messages. InputError with file:line for a faulty header, a field that is not a finite number or
/// is absurdly large, a quaternion whose norm is off by more than 1e-3 (within that it is
/// normalised), times that do not increase strictly, and when there is no pose.
Trajectory parse_csv_trajectory(std::string_view text, const std::string& file);

/// Poses from TUM text: lines of `t x y z qx qy qz qw`, seconds and metres, set apart by blanks;
/// from '#' to the end of a line is comment. InputError with file:line:column as for CSV.
Trajectory parse_tum(std::string_view text, const std::string& file);

/// The poses as TUM text, a comment with the names of the columns first. parse_tum gives back the
/// same numbers, bit for bit.
std::string write_tum(const Trajectory& trajectory);

}  // namespace sonarsim
