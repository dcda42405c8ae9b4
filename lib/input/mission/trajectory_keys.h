#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of a trajectory, of the vehicle or of a moving object, as in mission.h.

namespace sonarsim {

/// Poses from a file, either as they are or interpolated at `rate_hz`.
struct FileTrajectoryConfig {
    std::filesystem::path file;  ///< .csv or TUM .txt/.tum
    double rate_hz = 0.0;        ///< 0: one ping per pose of the file
    Location place = {};         ///< in the mission
};

struct WaypointConfig {
    std::array<double, 3> position_m{};
    std::array<double, 3> rpy_deg{};
};

/// Straight legs from waypoint to waypoint at constant speed.
struct WaypointTrajectoryConfig {
    std::vector<WaypointConfig> waypoints;
    double speed_m_s = 1.0;
    double rate_hz = 10.0;
};

/// Parallel lines over a rectangle, in alternating directions.
struct LawnmowerTrajectoryConfig {
    std::array<double, 2> area_min_m{};  ///< x, y
    std::array<double, 2> area_max_m{};
    double z_m = 0.0;          ///< world height of the vehicle
    double heading_deg = 0.0;  ///< direction of the first line
    double line_spacing_m = 5.0;
    double speed_m_s = 1.0;
    double rate_hz = 10.0;
    double altitude_m = 0.0;  ///< above the bottom; 0: z_m applies
    bool z_given = false;     ///< the mission has z_m
    bool turns = true;        ///< poses between the lines, too
};

/// Poses that each have a drawn object in view.
struct LookAtTrajectoryConfig {
    std::string look_at;  ///< a class, several with commas, or all_objects
    int count = 100;
    std::array<double, 2> range_m{};  ///< to the middle of the object, seen from above
    std::array<double, 2> bearing_deg{-20.0, 20.0};
    std::array<double, 2> elevation_deg{-4.0, 4.0};
    std::array<double, 2> height_m{1.0, 3.0};  ///< above the lowest point of the object
};
inline constexpr const char* all_objects = "objects";

/// Standard deviations of the movements that waves add to a trajectory.
struct MotionConfig {
    std::array<double, 3> position_m{};  ///< surge, sway, heave
    std::array<double, 3> turn_deg{};    ///< roll, pitch, yaw
    double period_s = 8.0;               ///< at the spectrum's peak
};

/// Standard deviations of the errors of a vehicle's navigation.
struct NavigationConfig {
    double position_m = 0.0;
    double depth_m = 0.0;
    double tilt_deg = 0.0;
    double heading_deg = 0.0;

    bool operator==(const NavigationConfig&) const = default;
};

/// The offset of a vehicle from its trajectory, its movements and its navigation.
struct VehicleConfig {
    std::array<double, 3> offset_m{};  ///< world frame
    std::array<double, 3> turn_deg{};  ///< roll, pitch, yaw, vehicle frame
    MotionConfig motion = {};
    NavigationConfig navigation = {};
};

using TrajectoryConfig = std::variant<FileTrajectoryConfig, WaypointTrajectoryConfig,
                                      LawnmowerTrajectoryConfig, LookAtTrajectoryConfig>;

void describe(auto& v, FileTrajectoryConfig& c) {
    v.path("file", c.file, "timed poses, a .csv or a TUM .txt or .tum", required);
    v.number("rate_hz", c.rate_hz, at_least(0),
             "poses are interpolated at this rate; 0 pings at every pose of the file");
}

void describe(auto& v, WaypointConfig& c) {
    v.array("position_m", c.position_m, any_position_m, "x, y, z in the world", required);
    v.array("rpy_deg", c.rpy_deg, any_angle_deg, "roll, pitch and yaw of the vehicle");
}

void describe(auto& v, WaypointTrajectoryConfig& c) {
    v.list_of("waypoints", c.waypoints, 2,
              "poses in the order of the trajectory, joined by straight legs");
    v.number("speed_m_s", c.speed_m_s, above(0), "speed along the legs");
    v.number("rate_hz", c.rate_hz, above(0), "poses per second");
}

void describe(auto& v, LawnmowerTrajectoryConfig& c) {
    v.array("area_min_m", c.area_min_m, any_position_m,
            "corner of the rectangle with the least x and y", required);
    v.array("area_max_m", c.area_max_m, any_position_m,
            "corner of the rectangle with the largest x and y", required);
    v.number("z_m", c.z_m, any_position_m,
             "height of the vehicle in the world; negative below a surface at 0");
    v.note_given("z_m", c.z_given);
    v.number("altitude_m", c.altitude_m, at_least(0),
             "height above the bottom, in place of z_m; 0: z_m applies");
    v.flag("turns", c.turns, "false leaves out the poses between the lines");
    v.number("heading_deg", c.heading_deg, any_angle_deg,
             "direction of the first line; 0 is along x, positive to the left");
    v.number("line_spacing_m", c.line_spacing_m, above(0), "distance between the lines");
    v.number("speed_m_s", c.speed_m_s, above(0), "speed along the lines and between them");
    v.number("rate_hz", c.rate_hz, above(0), "poses per second");
    v.require(c.area_min_m[0] < c.area_max_m[0] && c.area_min_m[1] < c.area_max_m[1],
              {"area_min_m", "area_max_m"}, "area_min_m must be below area_max_m in x and in y");
    v.require(
        c.altitude_m > 0.0 ? c.z_m == 0.0 : c.z_given, {"z_m", "altitude_m"},
        "'lawnmower' needs one of z_m, a height in the world, and altitude_m, above the bottom");
}

void describe(auto& v, LookAtTrajectoryConfig& c) {
    v.text("look_at", c.look_at,
           "each pose has one of the `objects`, of a class, or of several (`mine, tyre`), in view. "
           "`objects` leaves out those longer than range_m, such as walls",
           required);
    v.number("count", c.count, between(1, 1e6), "number of poses, one second apart");
    v.number("range_m", c.range_m, above(0), "distance to its middle, seen from above", required);
    v.number("bearing_deg", c.bearing_deg, between(-180, 180),
             "its azimuth in the first fan, or from the bow if there is none; positive to port");
    v.number("elevation_deg", c.elevation_deg, between(-90, 90),
             "its elevation from the axis of the first fan; the vehicle pitches to it");
    v.number("height_m", c.height_m, any_position_m, "height above its lowest point");
}

void describe(auto& v, TrajectoryConfig& c) {
    v.one_of(c, {"file", "waypoints", "lawnmower", "look_at"});
    if (auto* lawnmower = std::get_if<LawnmowerTrajectoryConfig>(&c)) {
        v.section("lawnmower", *lawnmower, "parallel lines over a rectangle, to and fro", required);
    } else {
        std::visit([&v](auto& form) { describe(v, form); }, c);
    }
}

void describe(auto& v, MotionConfig& c) {
    v.array("position_m", c.position_m, between(0, 100),
            "standard deviations of surge (ahead), sway (to port) and heave (up)");
    v.array("turn_deg", c.turn_deg, between(0, 45), "standard deviations of roll, pitch and yaw");
    v.number("period_s", c.period_s, between(0.1, 1000),
             "period of the strongest waves; the spectrum is that of Pierson and Moskowitz");
}

void describe(auto& v, NavigationConfig& c) {
    v.number("position_m", c.position_m, at_least(0), "of x and of y, drawn for every pose");
    v.number("depth_m", c.depth_m, at_least(0), "of z, drawn for every pose");
    v.number("tilt_deg", c.tilt_deg, between(0, 45), "of roll and of pitch, drawn for every pose");
    v.number("heading_deg", c.heading_deg, between(0, 180), "of the heading, drawn for every pose");
}

void describe(auto& v, VehicleConfig& c) {
    v.array("offset_m", c.offset_m, any_position_m,
            "added to the position of every pose: x, y, z in the world");
    v.array("turn_deg", c.turn_deg, any_angle_deg,
            "roll, pitch and yaw that are added to every pose, in the vehicle's own frame");
    v.section("motion", c.motion, "movements by waves that are added to the trajectory");
    v.section("navigation", c.navigation,
              "errors of the poses that the vehicle reports, as standard deviations; images do not "
              "depend on them");
}

}  // namespace sonarsim
