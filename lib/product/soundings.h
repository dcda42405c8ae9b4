#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/pose.h"
#include "ping/ping.h"
#include "ping/sonar.h"

namespace sonarsim {

/// Where a beam of a profiling sonar met the bottom.
struct Sounding {
    double range_m = std::numeric_limits<double>::quiet_NaN();      ///< NaN: the beam is dark
    Eigen::Vector3d position = Eigen::Vector3d::Constant(range_m);  ///< world, m
    /// By how much the echo stands out of the beam, 0 to 1: 1 - mean outside / mean inside. Without
    /// noise 1 where the beam met one surface, with nothing but noise about a half.
    double quality = 0.0;
};

/// One sounding per beam, in the order of the beams.
///
/// The peak is sought where noise is equally strong at every range, so the growth of the additive
/// noise with range, Eq. 10, is divided out, and in the running mean over three bins, which a
/// speckle cannot lift far. The range is the centre of mass of the run of bins around the peak that
/// are at least half as bright. The position lies on the beam's centre, at elevation 0.
std::vector<Sounding> find_soundings(const Sonar& sonar, const Pose& T_world_vehicle,
                                     const Ping& ping);

}  // namespace sonarsim
