#include "simulate/assembly/poses.h"

#include <variant>

#include "core/elementary.h"
#include "core/error.h"
#include "core/input_limits.h"
#include "core/random.h"
#include "core/text.h"
#include "core/units.h"
#include "input/mission/ping_draws.h"
#include "input/trajectory/patterns.h"
#include "input/trajectory/trajectory.h"
#include "simulate/sonar/sonar.h"
#include "simulate/water/water_ray.h"

namespace sonarsim {

namespace {

Trajectory form_of(const FileTrajectoryConfig& config) {
    return read_named_at(config.place,
                         [&] { return resample(read_trajectory(config.file), config.rate_hz); });
}

Trajectory form_of(const WaypointTrajectoryConfig& config) {
    std::vector<Pose> waypoints;
    for (const WaypointConfig& waypoint : config.waypoints) {
        waypoints.push_back(
            {rotation_from_degrees(waypoint.rpy_deg), Eigen::Vector3d(waypoint.position_m.data())});
    }
    return follow_waypoints(waypoints, config.speed_m_s, config.rate_hz);
}

Trajectory form_of(const LawnmowerTrajectoryConfig& config) {
    return lawnmower(config);
}

/// The times alone: the poses are drawn when the scene is placed.
Trajectory form_of(const LookAtTrajectoryConfig& config) {
    Trajectory poses(static_cast<std::size_t>(config.count));
    for (std::size_t i = 0; i < poses.size(); ++i)
        poses[i].t_s = static_cast<double>(i);
    return poses;
}

PhiloxKey vehicle_key(const Mission& mission, const char* name) {
    return stream_key(mission.seed, 0, 0, stream_named(name));
}

/// A dataset has its poses in trajectory.tum, whose reader accepts only values within these limits.
void require_readable(const Trajectory& poses) {
    for (const TimedPose& pose : poses) {
        if (!(std::fabs(pose.t_s) <= furthest_s)) {
            throw InputError("trajectory: a pose at " + number_text(pose.t_s) + " s lies beyond " +
                             number_text(furthest_s) +
                             " s; let the vehicle be faster (speed_m_s), or begin at 0");
        }
        if (!(pose.T_world_vehicle.translation.cwiseAbs().maxCoeff() <= furthest_m)) {
            throw InputError("trajectory: with vehicle.offset_m or vehicle.motion a pose at " +
                             number_text(pose.t_s) + " s lies beyond " + number_text(furthest_m) +
                             " m; move the scene and the trajectory towards the origin");
        }
    }
}

/// The rotation vector of a unit quaternion.
Eigen::Vector3d rotation_vector(Eigen::Quaterniond q) {
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    const double sine = q.vec().norm();
    if (!(sine > 0.0)) return Eigen::Vector3d::Zero();
    return 2.0 * arctan2(sine, q.w()) / sine * q.vec();
}

/// The motion of a sonar at a pose: the difference of the neighbouring poses over that in time. A
/// neighbour that is more than `gap` times as far in time as the other one is left out.
PingMotion motion_at(const Trajectory& trajectory, std::uint32_t pose, const Sonar& sonar,
                     double sound_speed_m_s, double gap) {
    const auto* before = &trajectory[pose > 0 ? pose - 1 : 0];
    const auto* after = &trajectory[std::min<std::size_t>(pose + 1, trajectory.size() - 1)];
    const double before_s = trajectory[pose].t_s - before->t_s;
    const double after_s = after->t_s - trajectory[pose].t_s;
    if (after_s > 0.0 && before_s > gap * after_s)
        before = &trajectory[pose];
    else if (before_s > 0.0 && after_s > gap * before_s)
        after = &trajectory[pose];
    const double dt = after->t_s - before->t_s;
    if (!(dt > 0.0)) return {};
    // The poses of the mount, without the turn of the head from ping to ping.
    const Pose from = before->T_world_vehicle * sonar.T_vehicle_sensor;
    const Pose to = after->T_world_vehicle * sonar.T_vehicle_sensor;
    const Eigen::Vector3d turn_world =
        rotation_vector(to.rotation * from.rotation.conjugate()) / dt;
    const Eigen::Quaterniond to_sensor =
        sensor_pose(sonar, trajectory[pose].T_world_vehicle, pose).rotation.conjugate();
    return {to_sensor * ((to.translation - from.translation) / dt), to_sensor * turn_world,
            sound_speed_m_s};
}

}  // namespace

std::vector<Pose> poses_at(std::span<const Trajectory> motions, double t_s) {
    std::vector<Pose> poses;
    poses.reserve(motions.size());
    for (const Trajectory& motion : motions)
        poses.push_back(interpolate(motion, t_s).T_world_vehicle);
    return poses;
}

std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s) {
    if (!motions.empty()) return engine.at(poses_at(motions, t_s));
    return {std::shared_ptr<const VisibilityEngine>(), &engine};  // owns nothing
}

Trajectory poses_of(const TrajectoryConfig& config) {
    return std::visit([](const auto& form) { return form_of(form); }, config);
}

Trajectory path_of(TrajectoryConfig config) {
    std::visit(
        [](auto& form) {
            if constexpr (requires { form.rate_hz; }) form.rate_hz = 0.0;
        },
        config);
    return poses_of(config);
}

void keep_altitude(const Mission& mission, const Bottom* bottom, Trajectory& poses) {
    const auto* const lines = std::get_if<LawnmowerTrajectoryConfig>(&mission.trajectory);
    if (!lines || !(lines->altitude_m > 0.0)) return;
    // A vehicle follows the ground within its altitude, not ripples. The points stay where they are
    // and their weights fall to 0, so that no step of the ground is one of the vehicle.
    constexpr int steps = 5;
    const double step_m = lines->altitude_m / steps;
    for (TimedPose& pose : poses) {
        Eigen::Vector3d& at = pose.T_world_vehicle.translation;
        const Eigen::Vector2d first = (at.head<2>() / step_m).array().ceil() - steps;
        double sum = 0.0;
        double weights = 0.0;
        for (int k = 0; k < 4 * steps * steps; ++k) {
            const Eigen::Vector2d point =
                step_m * (first + Eigen::Vector2d(k % (2 * steps), k / (2 * steps)));
            const double off = (point - at.head<2>()).norm() / lines->altitude_m;
            const std::optional<double> ground =
                bottom && off < 1.0 ? bottom->highest(point) : std::nullopt;
            const double weight = (1.0 - off * off) * (1.0 - off * off);
            sum += ground ? weight * *ground : 0.0;
            weights += ground ? weight : 0.0;
        }
        if (weights == 0.0) {
            throw InputError({mission.scene.place.file},
                             "trajectory.lawnmower.altitude_m: there is no bottom below " +
                                 short_text(at.x(), 6) + ", " + short_text(at.y(), 6) +
                                 " m; name one without a hole in scene.bottom, or give z_m");
        }
        at.z() += sum / weights + lines->altitude_m;
    }
}

Trajectory vehicle_poses(const Mission& mission) {
    try {
        return moved_vehicle(mission, poses_of(mission.trajectory));
    } catch (const InputError& error) {
        const Location mission_file{mission.scene.place.file};
        const bool has_file = std::holds_alternative<FileTrajectoryConfig>(mission.trajectory);
        if (has_file || mission_file.file.empty()) throw;
        throw InputError(mission_file, std::string("trajectory: ") + error.what());
    }
}

Trajectory moved_vehicle(const Mission& mission, Trajectory poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const VehicleConfig off = vehicle_at(mission, static_cast<std::uint32_t>(i));
        if (off.offset_m == VehicleConfig{}.offset_m && off.turn_deg == VehicleConfig{}.turn_deg)
            continue;
        Pose& pose = poses[i].T_world_vehicle;
        pose.translation += Eigen::Vector3d(off.offset_m.data());
        pose.rotation = (pose.rotation * rotation_from_degrees(off.turn_deg)).normalized();
    }
    add_wave_motion(mission.vehicle.motion, vehicle_key(mission, "wave motion"), poses);
    require_readable(poses);
    return poses;
}

Trajectory navigation_poses(const Mission& mission, const Trajectory& truth) {
    const NavigationConfig& config = mission.vehicle.navigation;
    if (config == NavigationConfig{}) return {};
    return reported_poses(truth, config, vehicle_key(mission, "navigation"));
}

void add_ping_motions(const Mission& mission, const Trajectory& trajectory,
                      std::span<Sonar> sonars) {
    const double sound_speed_m_s = mission.water.sound_speed_m_s;
    for (Sonar& sonar : sonars) {
        if (!sonar.config.moves_in_ping) continue;
        const auto refuse_if = [&](bool is_refused, const char* reason) {
            if (is_refused) throw InputError("sensor '" + sonar.config.name + "': " + reason);
        };
        refuse_if(sonar.config.multipath.method != MultipathMethod::none,
                  "multipath supports only a sonar at rest during a ping; leave out multipath or "
                  "moves_in_ping");
        refuse_if(std::holds_alternative<LookAtTrajectoryConfig>(mission.trajectory),
                  "moves_in_ping takes speeds from successive poses, and those of "
                  "trajectory.look_at do not follow each other; leave out one");
        refuse_if(vehicle_varies_by_ping(mission),
                  "moves_in_ping takes speeds from successive poses, and `vary` draws a new offset "
                  "or turn of the vehicle for each; leave out one");
        // There are gaps between two lines, and in records, whose times are uneven, too.
        const auto* lines = std::get_if<LawnmowerTrajectoryConfig>(&mission.trajectory);
        const auto* file = std::get_if<FileTrajectoryConfig>(&mission.trajectory);
        const double gap = lines && !lines->turns         ? 1.0 + 1e-6
                           : file && file->rate_hz == 0.0 ? 2.0
                                                          : std::numeric_limits<double>::infinity();
        std::vector<PingMotion> motions;
        for (std::uint32_t pose = 0; pose < trajectory.size(); ++pose) {
            const SonarAtPose then(mission, sonar, pose);
            motions.push_back(motion_at(trajectory, pose, *then, sound_speed_m_s, gap));
            motions.back().measures_direction = sonar.head_angles_rad.empty();
        }
        sonar.motions = std::make_shared<const std::vector<PingMotion>>(std::move(motions));
    }
}

std::optional<double> measured_altitude_m(const Scene& scene, const VisibilityEngine& engine,
                                          const Pose& T_world_sensor) {
    const std::optional<double> altitude = altitude_m(engine, T_world_sensor);
    if (!altitude || !scene.sound_profile) return altitude;
    const Eigen::Vector3d& at = T_world_sensor.translation;
    const auto found =
        apparent_place(*scene.sound_profile, at, at - *altitude * Eigen::Vector3d::UnitZ());
    return found ? found->apparent.norm() : *altitude;
}

}  // namespace sonarsim
