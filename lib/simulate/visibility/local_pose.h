#pragma once

#include <Eigen/Core>

#include "core/pose.h"

namespace sonarsim {

/// A sensor pose relative to the scene's local origin.
struct LocalPose {
    Eigen::Matrix3f rotation;  ///< R_local_sensor
    Eigen::Vector3f position;  ///< m
};

inline LocalPose local_pose(const Pose& T_world_sensor, const Eigen::Vector3d& scene_origin) {
    return {T_world_sensor.rotation.toRotationMatrix().cast<float>(),
            (T_world_sensor.translation - scene_origin).cast<float>()};
}

}  // namespace sonarsim
