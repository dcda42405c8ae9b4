#pragma once

#include "core/random.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

/// Standard deviations of the errors of a vehicle's navigation, which are drawn for every pose.
struct NavigationErrors {
    double position_m = 0.0;  ///< x and y
    double depth_m = 0.0;     ///< z
    double tilt_rad = 0.0;    ///< roll and pitch
    double heading_rad = 0.0;

    bool is_on() const;
};

/// The poses that the vehicle's instruments report: the true ones with the errors.
Trajectory reported_poses(const Trajectory& truth, const NavigationErrors& errors, PhiloxKey draws);

}  // namespace sonarsim
