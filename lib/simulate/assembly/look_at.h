#pragma once

#include <cstdint>

#include "input/mission/trajectory_keys.h"
#include "input/scene/objects.h"
#include "input/scene/scene.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

/// The poses of `trajectory.look_at`, one second apart from 0 on. Each has an object at a drawn
/// distance and height, and at a drawn azimuth and elevation of the sensor that `mount`
/// (T_vehicle_sensor) places; null: at an azimuth from the bow of a level vehicle. The sensor lies
/// within the bounds of the scene, seen from above, and outside of the boxes of all objects that
/// are no background. Something may hide the object. Objects that move are left out. Where no
/// object of known classes was placed, a drawn place of the scene stands for one. InputError if
/// there is no such object or class, or no room for a pose.
Trajectory look_at_poses(const LookAtTrajectoryConfig& config, const Scene& scene,
                         const SceneObjects& objects, const Pose* mount, std::uint64_t seed);

}  // namespace sonarsim
