#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Gives the sonars the age of the water's speckle at each pose, if water.drift_rms_m_s is given.
/// Those with `speckle: ping` have none: their speckle is new in each ping.
///
/// Speckle one age apart has an eighth of the correlation of power, and speckle two ages apart
/// none. With normal velocities of the RMS value u along the line of sight, the phases 2 k r of
/// scatterers drift apart by 2 k u t in a time t, and the amplitude of a resolution cell has the
/// correlation of the characteristic function, exp(-(2 k u t)^2 / 2). The draws have the
/// correlation cos(pi s / 2) over a part s of an age, which, if s = 2 / pi 2 k u t, agrees to
/// second order in t.
///
/// The sonar's motion through the water adds to the age, too. It adds one age per half of the
/// array's length, after which the power of a line array is uncorrelated, or per range bin of the
/// pulse if that is shorter, and one per width of the beam. So water to which the sonar returns has
/// new speckle.
void add_water_ages(const Mission& mission, const Trajectory& trajectory, std::span<Sonar> sonars);

}  // namespace sonarsim
