#pragma once

#include "core/random.h"
#include "input/mission/trajectory_keys.h"
#include "input/trajectory/trajectory.h"

namespace sonarsim {

/// Adds the movements to every pose, in the vehicle's frame there. Each of the six is a sum of 64
/// cosines with random phases that share the energy of a Pierson-Moskowitz spectrum equally:
/// S(f) ~ f^-5 exp(-1.25 (f_p / f)^4) with the peak f_p = 1 / period_s has the share
/// u = exp(-1.25 (f_p / f)^4) of its energy below f, so cosine k has
/// f_k = f_p (1.25 / -ln u_k)^(1/4), u_k drawn in [k, k + 1) / 64, and the amplitude
/// sqrt(2 / 64) standard deviations. The six are independent of each other.
void add_wave_motion(const MotionConfig& motion, PhiloxKey draws, Trajectory& poses);

/// The poses that the vehicle's instruments report: the true ones with the errors.
Trajectory reported_poses(const Trajectory& truth, const NavigationConfig& errors, PhiloxKey draws);

}  // namespace sonarsim
