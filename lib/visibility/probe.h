#pragma once

#include <algorithm>
#include <span>

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

/// The finest goal and the most columns of rays that the probes of a view require; a goal of 0 if
/// no probe requires rays.
inline RaysNeed required_rays(const View& view, std::span<const Probe> probes) {
    RaysNeed need;
    for (const Probe& probe : probes) {
        if (probe.view != view || probe.rays.goal == 0.0) continue;
        need.goal = need.goal == 0.0 ? probe.rays.goal : std::min(need.goal, probe.rays.goal);
        need.columns = std::max(need.columns, probe.rays.columns);
    }
    return need;
}

}  // namespace sonarsim
