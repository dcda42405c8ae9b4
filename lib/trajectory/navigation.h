#pragma once

#include "core/random.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Standard deviations of the errors of a vehicle's navigation: a compass, roll and pitch sensors,
/// a pressure sensor, and either position fixes or dead reckoning by a velocity log.
struct NavigationErrors {
    double position_m = 0.0;           ///< x and y, drawn for every pose
    double depth_m = 0.0;              ///< z, drawn for every pose
    double tilt_rad = 0.0;             ///< roll and pitch, drawn for every pose
    double heading_rad = 0.0;          ///< drawn for every pose
    double heading_bias_rad = 0.0;     ///< drawn once
    double heading_drift_rad_s = 0.0;  ///< drawn once
    double speed_scale = 0.0;          ///< share of the speed, drawn once

    bool is_on() const;
};

/// The poses that the vehicle's instruments report. Steps of the horizontal track, scaled by
/// 1 + speed_scale and turned by the bias and drift of the heading, are summed from the true first
/// position, so the error grows with the distance run. Without bias, drift and scale the track is
/// the true one. The errors drawn for every pose are added to this track.
Trajectory reported_poses(const Trajectory& truth, const NavigationErrors& errors, PhiloxKey draws);

}  // namespace sonarsim
