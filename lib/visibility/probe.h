#pragma once

#include <algorithm>
#include <span>

#include "core/pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// A view and a pose for the choice of an engine.
struct Probe {
    View view;
    Pose T_world_sensor;
    double rays_goal = 0.0;  ///< above 0: use rays with this goal, whatever the slices' error
};

/// The finest goal that the probes of a view require of rays; 0 if they require none.
inline double required_goal(const View& view, std::span<const Probe> probes) {
    double goal = 0.0;
    for (const Probe& probe : probes) {
        if (probe.view != view || probe.rays_goal == 0.0) continue;
        goal = goal == 0.0 ? probe.rays_goal : std::min(goal, probe.rays_goal);
    }
    return goal;
}

}  // namespace sonarsim
