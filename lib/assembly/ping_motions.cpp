#include "assembly/ping_motions.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/poses.h"
#include "calibrated/pulse_band.h"
#include "core/elementary.h"
#include "core/error.h"
#include "mission/ping_draws.h"
#include "sonar/sonar_at_pose.h"

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

/// The motions of the objects at a pose, computed like those of a sonar.
std::vector<ObjectMotion> object_motions_at(const Scene& scene, std::span<const Trajectory> bodies,
                                            const Trajectory& trajectory, std::size_t pose) {
    const double before = trajectory[pose > 0 ? pose - 1 : 0].t_s;
    const double after = trajectory[std::min(pose + 1, trajectory.size() - 1)].t_s;
    if (!(after > before)) return {};
    const std::vector<Pose> from = poses_at(bodies, before);
    const std::vector<Pose> to = poses_at(bodies, after);
    const std::vector<Pose> now = poses_at(bodies, trajectory[pose].t_s);
    std::vector<ObjectMotion> out;
    for (std::size_t k = 0; k < now.size(); ++k) {
        const double per_s = 1.0 / (after - before);
        const Eigen::Vector3d turn = rotation_vector(to[k].rotation * from[k].rotation.conjugate());
        const ObjectMotion motion{.instance = scene.bodies[k].instance,
                                  .centre_m = now[k].translation,
                                  .velocity_m_s = per_s * (to[k].translation - from[k].translation),
                                  .turn_rad_s = per_s * turn};
        if (!motion.velocity_m_s.isZero(0.0) || !turn.isZero(0.0)) out.push_back(motion);
    }
    return out;
}

double swept_hz(const SonarConfig& config, double sound_speed_m_s) {
    // A pulse without resolution_m is as long as a sample, of which a bin may have several.
    const double samples = 1.0 * config.range_bins * config.instrument.receiver.samples;
    const double sample_m = (config.range_max_m - config.range_min_m) / samples;
    return pulse_band(config.instrument.pulse, sample_m, sound_speed_m_s).sweep_hz;
}

/// Range shift over speed, f T / B, of a pulse that sweeps over B in T. A shift of 2 v f / c in
/// frequency makes the matched filter of an up-sweep respond earlier by this shift over B / T.
double doppler_of(const SonarConfig& config, double sound_speed_m_s) {
    const PulseConfig& pulse = config.instrument.pulse;
    const double shift_s =
        config.instrument.frequency_hz * pulse.duration_s / swept_hz(config, sound_speed_m_s);
    return pulse.sweep == Sweep::up ? shift_s : -shift_s;
}

DopplerLoss doppler_loss_of(const SonarConfig& config, double sound_speed_m_s) {
    const PulseConfig& pulse = config.instrument.pulse;
    const double hz_s_per_m = 2.0 * config.instrument.frequency_hz / sound_speed_m_s;
    if (pulse.sweep == Sweep::tone) return {.turns_s_per_m = hz_s_per_m * pulse.duration_s};
    return {.band_s_per_m = hz_s_per_m / swept_hz(config, sound_speed_m_s)};
}

/// Sets the Doppler shift and loss of the sonar's pulse.
void add_doppler(const SonarConfig& config, double sound_speed_m_s, PingMotion& motion) {
    const Sweep sweep = config.instrument.pulse.sweep;
    if (config.model != ModelKind::calibrated || sweep == Sweep::none) return;
    if (sweep != Sweep::tone) motion.doppler_s = doppler_of(config, sound_speed_m_s);
    motion.loss = doppler_loss_of(config, sound_speed_m_s);
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
        for (PingMotion& motion : motions) {
            add_doppler(sonar.config, sound_speed_m_s, motion);
            motion.measures_direction = sonar.head_angles_rad.empty();
        }
        sonar.motions = std::make_shared<const std::vector<PingMotion>>(std::move(motions));
    }
}

void add_object_motions(const Trajectory& trajectory, const Scene& scene,
                        std::span<const Trajectory> bodies, std::span<Sonar> sonars) {
    for (Sonar& sonar : sonars) {
        if (!sonar.config.moves_in_ping || bodies.empty()) continue;
        std::vector<std::vector<ObjectMotion>> of_objects;
        for (std::size_t pose = 0; pose < trajectory.size(); ++pose)
            of_objects.push_back(object_motions_at(scene, bodies, trajectory, pose));
        sonar.object_motions =
            std::make_shared<const std::vector<std::vector<ObjectMotion>>>(std::move(of_objects));
    }
}

void leave_out_glints(std::span<Sonar> sonars, Scene& scene) {
    for (Sonar& sonar : sonars) {
        if (!sonar.motions || !sonar.settings.coherent) continue;
        sonar.settings.coherent = nullptr;
        scene.warnings.push_back(
            "sensors." + sonar.config.name +
            ".moves_in_ping: the coherent echo of smooth faces (materials with roughness_m) "
            "supports only a sonar at rest, so they scatter incoherently");
    }
}

}  // namespace sonarsim
