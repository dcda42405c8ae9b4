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

/// Parallel lines over a rectangle at constant height, in alternating directions.
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

/// Standard deviations of the movements that waves add to a trajectory.
struct MotionConfig {
    std::array<double, 3> position_m{};  ///< surge, sway, heave
    std::array<double, 3> turn_deg{};    ///< roll, pitch, yaw
    double period_s = 8.0;               ///< at the spectrum's peak
    double lag_s = 0.0;                  ///< time constant by which a towed vehicle follows

    bool operator==(const MotionConfig&) const = default;
};

/// Standard deviations of the errors of a vehicle's navigation.
struct NavigationConfig {
    double position_m = 0.0;
    double depth_m = 0.0;
    double tilt_deg = 0.0;
    double heading_deg = 0.0;
    double heading_bias_deg = 0.0;
    double speed_scale = 0.0;

    bool operator==(const NavigationConfig&) const = default;
};

/// The offset of a vehicle from its trajectory, its movements and its navigation.
struct VehicleConfig {
    std::array<double, 3> offset_m{};  ///< world frame
    std::array<double, 3> turn_deg{};  ///< roll, pitch, yaw, vehicle frame
    MotionConfig motion = {};
    NavigationConfig navigation = {};

    bool operator==(const VehicleConfig&) const = default;
};

using TrajectoryConfig =
    std::variant<FileTrajectoryConfig, WaypointTrajectoryConfig, LawnmowerTrajectoryConfig>;

}  // namespace sonarsim
