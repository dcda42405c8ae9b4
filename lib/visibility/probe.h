#pragma once

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// The rays that a sonar needs.
struct RaysNeed {
    double goal = 0.0;  ///< above 0: rays with this error goal are required
    int columns = 1;    ///< factor on the columns for the goal, see make_rays_engine()
};

/// A view and a pose for the choice of an engine.
struct Probe {
    View view;
    Pose T_world_sensor;
    RaysNeed rays = {};
};

}  // namespace sonarsim
