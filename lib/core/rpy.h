#pragma once

#include "core/pose.h"

namespace sonarsim {

/// Radians: roll and yaw in [-pi, pi], pitch in [-pi / 2, pi / 2].
struct Rpy {
    double roll = 0.0;
    double pitch = 0.0;
    double yaw = 0.0;
};

/// The angles of rotation_from_rpy(). Where the bow points straight up or down only the sum or the
/// difference of roll and yaw counts: roll is 0 then.
Rpy rpy_from_rotation(const Eigen::Quaterniond& rotation);

}  // namespace sonarsim
