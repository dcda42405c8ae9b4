#pragma once

#include <span>
#include <vector>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// By sonar, the intensity that becomes white in pictures: output.full_scale, or where that is
/// `auto` what 99 % of the lit bins of a few pings, spread over the trajectory, do not exceed,
/// but at most ten times what 90 % do not, rounded up to two digits; 1 where these see nothing. The
/// same for every part of the mission, any number of threads and any engine, for the probes are
/// always seen with rays. `motions` are those of the scene's bodies.
std::vector<double> find_full_scales(const Mission& mission, const Scene& scene,
                                     const Trajectory& trajectory,
                                     std::span<const Trajectory> motions,
                                     std::span<const Sonar> sonars);

}  // namespace sonarsim
