#pragma once

#include <array>

#include "core/random.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

/// Standard deviations of the movements that waves add to a trajectory, and their period.
struct WaveMotion {
    std::array<double, 3> position_m{};  ///< surge (ahead), sway (to port), heave (up)
    std::array<double, 3> turn_rad{};    ///< roll, pitch, yaw
    double period_s = 8.0;               ///< at the spectrum's peak

    bool is_on() const;
};

/// Adds the movements to every pose, in the vehicle's frame there. Each of the six is a sum of 64
/// cosines with random phases that share the energy of a Pierson-Moskowitz spectrum equally:
/// S(f) ~ f^-5 exp(-1.25 (f_p / f)^4) with the peak f_p = 1 / period_s has the share
/// u = exp(-1.25 (f_p / f)^4) of its energy below f, so cosine k has
/// f_k = f_p (1.25 / -ln u_k)^(1/4), u_k drawn in [k, k + 1) / 64, and the amplitude
/// sqrt(2 / 64) standard deviations. The six are independent of each other.
void add_wave_motion(const WaveMotion& motion, PhiloxKey draws, Trajectory& poses);

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
