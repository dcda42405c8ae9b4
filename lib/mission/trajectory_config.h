#pragma once

#include <array>
#include <filesystem>
#include <variant>
#include <vector>

namespace sonarsim {

/// Poses from a file, either as they are or interpolated at `rate_hz`.
struct FileTrajectoryConfig {
    std::filesystem::path file;  ///< .csv or TUM .txt/.tum
    double rate_hz = 0.0;        ///< 0: one ping per pose of the file

    bool operator==(const FileTrajectoryConfig&) const = default;
};

struct WaypointConfig {
    std::array<double, 3> position_m{};
    std::array<double, 3> rpy_deg{};

    bool operator==(const WaypointConfig&) const = default;
};

/// Straight legs from waypoint to waypoint at constant speed.
struct WaypointTrajectoryConfig {
    std::vector<WaypointConfig> waypoints;
    double speed_m_s = 1.0;
    double rate_hz = 10.0;

    bool operator==(const WaypointTrajectoryConfig&) const = default;
};

/// Parallel lines over a rectangle at constant height, run to and fro.
struct LawnmowerTrajectoryConfig {
    std::array<double, 2> area_min_m{};  ///< x, y
    std::array<double, 2> area_max_m{};
    double z_m = 0.0;          ///< world height of the vehicle
    double heading_deg = 0.0;  ///< direction of the first line
    double line_spacing_m = 5.0;
    double speed_m_s = 1.0;
    double rate_hz = 10.0;

    bool operator==(const LawnmowerTrajectoryConfig&) const = default;
};

/// Offset of a vehicle from the poses of its trajectory.
struct VehicleConfig {
    std::array<double, 3> offset_m{};  ///< world frame
    std::array<double, 3> turn_deg{};  ///< roll, pitch, yaw, vehicle frame

    bool operator==(const VehicleConfig&) const = default;
};

using TrajectoryConfig =
    std::variant<FileTrajectoryConfig, WaypointTrajectoryConfig, LawnmowerTrajectoryConfig>;

}  // namespace sonarsim
