#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// Gives the sonars the age of the water's speckle at each pose, if water.drift_rms_m_s is given.
/// Those with `speckle: ping` have none: their speckle is new in each ping.
///
/// Speckle one age apart is independent but for an eighth of its power's correlation, and two ages
/// apart wholly. With normal velocities of the RMS value u along the line of sight, the phases 2 k
/// r of scatterers drift apart by 2 k u t in a time t, and the amplitude of a resolution cell has
/// the correlation of the characteristic function, exp(-(2 k u t)^2 / 2). The draws one age apart
/// have cos(pi s / 2) over a part s of an age, which begins alike with s = 2 / pi 2 k u t.
///
/// The sonar's motion through the water ages it, too: by one over half of its array, where the
/// power of a line array has lost its correlation, or over a range bin of the pulse if that is
/// shorter, and by one over the width of its beam. So what the sonar leaves and comes back to is
/// new.
void add_water_ages(const Mission& mission, const Trajectory& trajectory, std::span<Sonar> sonars);

}  // namespace sonarsim
