#pragma once

#include <vector>

#include "core/pose.h"

namespace sonarsim {

struct TimedPose {
    double t_s = 0.0;
    Pose T_world_vehicle;
};

/// Poses in strictly increasing time.
using Trajectory = std::vector<TimedPose>;

}  // namespace sonarsim
