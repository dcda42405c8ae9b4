#pragma once

#include <Eigen/Core>

#include "core/pose.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/water/water_ray.h"

namespace sonarsim {

/// The true place, in the world, of an apparent place in the sonar's frame. `profile` bends the
/// sound; null: paths are straight.
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
