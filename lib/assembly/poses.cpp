#include "assembly/poses.h"

#include <variant>

#include "core/units.h"
#include "trajectory/files.h"
#include "trajectory/interpolate.h"
#include "trajectory/patterns.h"

namespace sonarsim {

namespace {

Trajectory form_of(const FileTrajectoryConfig& config) {
    Trajectory poses = read_trajectory(config.file);
    return config.rate_hz > 0.0 ? resample(poses, config.rate_hz) : poses;
}

Trajectory form_of(const WaypointTrajectoryConfig& config) {
    std::vector<Waypoint> waypoints;
    for (const WaypointConfig& waypoint : config.waypoints) {
        const auto& [roll, pitch, yaw] = waypoint.rpy_deg;
        waypoints.push_back({Eigen::Vector3d(waypoint.position_m.data()),
                             rotation_from_rpy(radians(roll), radians(pitch), radians(yaw))});
    }
    return follow_waypoints(waypoints, config.speed_m_s, config.rate_hz);
}

Trajectory form_of(const LawnmowerTrajectoryConfig& config) {
    return lawnmower({Eigen::Vector2d(config.area_min_m.data()),
                      Eigen::Vector2d(config.area_max_m.data()), config.z_m, config.heading_deg,
                      config.line_spacing_m, config.speed_m_s, config.rate_hz});
}

}  // namespace

std::vector<Pose> poses_at(std::span<const Trajectory> motions, double t_s) {
    std::vector<Pose> poses;
    poses.reserve(motions.size());
    for (const Trajectory& motion : motions)
        poses.push_back(interpolate(motion, t_s).T_world_vehicle);
    return poses;
}

Trajectory poses_of(const TrajectoryConfig& config) {
    return std::visit([](const auto& form) { return form_of(form); }, config);
}

}  // namespace sonarsim
