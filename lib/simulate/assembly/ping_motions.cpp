#include "simulate/assembly/ping_motions.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "input/mission/ping_draws.h"
#include "simulate/sonar/sonar_at_pose.h"

namespace sonarsim {

namespace {

/// The rotation vector of a unit quaternion.
Eigen::Vector3d rotation_vector(Eigen::Quaterniond q) {
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    const double sine = q.vec().norm();
    if (!(sine > 0.0)) return Eigen::Vector3d::Zero();
    return 2.0 * arctan2(sine, q.w()) / sine * q.vec();
}

/// The motion of a sonar at a pose: the difference of the neighbouring poses over their time
/// difference.
PingMotion motion_at(const Trajectory& trajectory, std::size_t pose, const Sonar& sonar,
                     double sound_speed_m_s) {
    const TimedPose& before = trajectory[pose > 0 ? pose - 1 : 0];
    const TimedPose& after = trajectory[std::min(pose + 1, trajectory.size() - 1)];
    const double dt = after.t_s - before.t_s;
    if (!(dt > 0.0)) return {};
    // The poses of the mount, without the turn of the head from ping to ping.
    const Pose from = before.T_world_vehicle * sonar.T_vehicle_sensor;
    const Pose to = after.T_world_vehicle * sonar.T_vehicle_sensor;
    const Eigen::Vector3d turn_world =
        rotation_vector(to.rotation * from.rotation.conjugate()) / dt;
    const Eigen::Quaterniond to_sensor =
        sensor_pose(sonar, trajectory[pose].T_world_vehicle, static_cast<std::uint32_t>(pose))
            .rotation.conjugate();
    return {to_sensor * ((to.translation - from.translation) / dt), to_sensor * turn_world,
            sound_speed_m_s};
}

}  // namespace

void add_ping_motions(const Mission& mission, const Trajectory& trajectory,
                      std::span<Sonar> sonars) {
    const double sound_speed_m_s = mission.water.sound_speed_m_s;
    for (Sonar& sonar : sonars) {
        if (!sonar.config.moves_in_ping) continue;
        if (sonar.config.multipath.method != MultipathMethod::none) {
            throw InputError("sensor '" + sonar.config.name +
                             "': multipath supports only a sonar at rest during a ping; leave out "
                             "multipath or moves_in_ping");
        }
        if (std::holds_alternative<LookAtTrajectoryConfig>(mission.trajectory)) {
            throw InputError("sensor '" + sonar.config.name +
                             "': moves_in_ping takes speeds from successive poses, and those of "
                             "trajectory.look_at do not follow each other; leave out one");
        }
        if (vehicle_varies_by_ping(mission)) {
            throw InputError(
                "sensor '" + sonar.config.name +
                "': moves_in_ping takes speeds from successive poses, and `vary` draws "
                "a new offset or turn of the vehicle for each; leave out one");
        }
        std::vector<PingMotion> motions;
        for (std::size_t pose = 0; pose < trajectory.size(); ++pose)
            motions.push_back(motion_at(
                trajectory, pose, *SonarAtPose(mission, sonar, static_cast<std::uint32_t>(pose)),
                sound_speed_m_s));
        for (PingMotion& motion : motions)
            motion.measures_direction = sonar.head_angles_rad.empty();
        sonar.motions = std::make_shared<const std::vector<PingMotion>>(std::move(motions));
    }
}

}  // namespace sonarsim
