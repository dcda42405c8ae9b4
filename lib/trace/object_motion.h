#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "trace/ping_motion.h"
#include "trace/target_surface.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The motion of an object of the scene in a ping, at constant rates.
struct ObjectMotion {
    std::uint32_t instance = 0;  ///< index into Scene::instances
    Eigen::Vector3d centre_m;    ///< the centre of its rotation at the ping's time, world
    Eigen::Vector3d velocity_m_s, turn_rad_s;  ///< world
};

/// The objects that move in a ping, for one transmission of it.
struct MovingObjects {
    std::span<const ObjectMotion> all;
    double later_s = 0.0;  ///< delay of the transmission after the ping's time
};

/// The time after which sound from the origin meets a point that is at `place` now.
double meeting_time(double sound_speed_m_s, const Eigen::Vector3d& place,
                    const Eigen::Vector3d& velocity_m_s);

/// The place that a sonar at rest measures for a point that is at `place` at transmission: the
/// place where the sound meets it, with the range shift of a pulse that sweeps.
Eigen::Vector3d met_place(const PingMotion& sonar, const Eigen::Vector3d& place,
                          const Eigen::Vector3d& velocity_m_s);

/// Moves the samples and facets of objects from where they are at the time of the ping to where
/// the sound meets them. The pose is that of the transmission. Only the speed of sound and the
/// range shift of `sonar` are used; move_in_ping() applies the sonar's motion.
void move_objects(const MovingObjects& moving, const PingMotion& sonar, const Pose& T_world_sensor,
                  std::span<Sample> samples);
void move_objects(const MovingObjects& moving, const PingMotion& sonar, const Pose& T_world_sensor,
                  std::span<TargetFacet> facets);

/// Weakens echoes by the loss of the matched filter for their Doppler shift, from the motion of
/// sonar and object.
void fade_by_doppler(const MovingObjects& moving, const PingMotion& sonar,
                     const Pose& T_world_sensor, std::span<Sample> samples);
void fade_by_doppler(const MovingObjects& moving, const PingMotion& sonar,
                     const Pose& T_world_sensor, std::span<TargetFacet> facets);

}  // namespace sonarsim
