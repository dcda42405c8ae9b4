#pragma once

#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "input/trajectory/trajectory.h"
#include "simulate/ping/sonar.h"
#include "simulate/visibility/caster.h"

namespace sonarsim {

struct Brightness {
    std::vector<double> full_scales;       ///< for each sonar
    std::shared_ptr<const Caster> caster;  ///< over the scene, if one was made; null: none
};

/// The intensity that becomes white in pictures, by sonar: output.full_scale, or for `auto` the
/// echo model's rule (EchoModelInfo::white), or without one the 99 % quantile of the bins with
/// surface of a few pings spread over the trajectory, at most ten times their 90 % quantile; 1 if
/// these pings have no echo. `auto` is rounded up to two digits. It does not depend on the shard,
/// the number of threads or the engine, since the probes always use rays. `motions`: of bodies.
Brightness find_full_scales(const Mission& mission, const Scene& scene,
                            const Trajectory& trajectory, std::span<const Trajectory> motions,
                            std::span<const Sonar> sonars, SharedTrees& trees);

}  // namespace sonarsim
