#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "input/trajectory/trajectory.h"

namespace sonarsim {

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
