#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/pose.h"
#include "ping/sonar.h"
#include "trace/ping.h"

namespace sonarsim {

/// Where a beam of a profiling sonar met the bottom.
struct Sounding {
    double range_m = std::numeric_limits<double>::quiet_NaN();      ///< NaN: the beam is dark
    Eigen::Vector3d position = Eigen::Vector3d::Constant(range_m);  ///< world, m
    /// How little of the beam could be mistaken for it, 0 to 1: 1 - (c / C)^2 with the contrast C
    /// of its run of bins and the greatest one c elsewhere in the beam. 1 where the beam met one
    /// surface and there is no noise; below a half where noise alone may well have made it.
    double quality = 0.0;
};

/// How many beams saw anything: so many soundings find_soundings() makes.
int lit_beams(const Ping& ping);

/// One sounding per beam, in the order of the beams.
///
/// A beam is divided by the growth of the additive noise with range, Eq. 10, so that noise is
/// equally strong everywhere. The range is the middle of its strongest_run(), less what range noise
/// moves that by (run_offsets_m). The position lies on the beam's centre, at elevation 0.
std::vector<Sounding> find_soundings(const Sonar& sonar, const Pose& T_world_vehicle,
                                     const Ping& ping);

}  // namespace sonarsim
