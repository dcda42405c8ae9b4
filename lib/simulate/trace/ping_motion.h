#pragma once

#include "core/pose.h"
#include "simulate/visibility/engine.h"
#include "simulate/water/water_ray.h"

namespace sonarsim {

/// The motion of a sonar during a ping, at constant rates in its frame at transmission.
struct PingMotion {
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();
    double sound_speed_m_s = 0.0;  ///< 0: the sonar stands still
    /// False for a fan of one beam, as of a scanning sonar, which measures no direction.
    bool measures_direction = true;

    bool is_still() const {
        return !(sound_speed_m_s > 0.0) || (velocity_m_s.isZero(0.0) && turn_rad_s.isZero(0.0));
    }
};

/// The same motion in the sonar's frame at a later transmission.
PingMotion motion_after(const PingMotion& motion, double later_s);
/// The pose of the sonar at that transmission.
Pose pose_after(const PingMotion& motion, const Pose& T_world_sensor, double later_s);

/// The place that a moving sonar measures for `place`, which is in its frame at transmission. The
/// range is half of the path out from the pose of transmission and back to the pose of reception.
/// The array of a fan measures the azimuth from the pose of reception; its transmitter is directed
/// in elevation, so the elevation is that at transmission. In a side-scan sonar or a cone only the
/// product of both patterns matters, so the direction is that from the pose half way between.
Eigen::Vector3d measured_place(const PingMotion& motion, ViewShape shape,
                               const Eigen::Vector3d& place);

/// The inverse of measured_place().
Eigen::Vector3d unmoved_place(const PingMotion& motion, ViewShape shape,
                              const Eigen::Vector3d& measured);

/// Moves the samples of a sonar at rest to where the moving sonar measures them. The visible
/// surface of a fan is then sorted into beams again.
void move_in_ping(const PingMotion& motion, const View& view, Samples& samples);

/// The true place, in the world, of an apparent place in the sonar's frame. No profile: straight.
inline Eigen::Vector3d true_place(const SoundProfile* profile, const Pose& T_world_sensor,
                                  const Eigen::Vector3d& measured) {
    if (!profile) return T_world_sensor.rotation * measured + T_world_sensor.translation;
    const double range = measured.norm();
    return place_of(*profile, T_world_sensor.translation,
                    T_world_sensor.rotation * (measured / range), range);
}

/// The same for a ping.
struct TruePlaces {
    Pose T_world_sensor;
    const SoundProfile* profile = nullptr;
    PingMotion motion = {};
    ViewShape shape = ViewShape::fan;

    Eigen::Vector3d of(const Eigen::Vector3d& measured) const {
        return true_place(profile, T_world_sensor,
                          motion.is_still() ? measured : unmoved_place(motion, shape, measured));
    }
    bool is_measured() const { return profile == nullptr && motion.is_still(); }
};

}  // namespace sonarsim
