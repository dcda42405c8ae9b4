#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/pose.h"
#include "simulate/ping/sonar.h"
#include "simulate/trace/ping.h"
#include "simulate/trace/ping_motion.h"

namespace sonarsim {

/// The return of the bottom in one beam of a profiling sonar.
struct Sounding {
    double range_m = std::numeric_limits<double>::quiet_NaN();      ///< NaN: the beam is dark
    Eigen::Vector3d position = Eigen::Vector3d::Constant(range_m);  ///< world, m
    /// 1 - (c / C)^2, where C is the contrast of the return and c the greatest contrast elsewhere
    /// in the beam. 1 for one surface without noise; below 0.5 it may be noise alone. In the
    /// calibrated model times 1 - 0.003 s and 1 - 4 / b, where the strongest beam has s times, and
    /// the background 1 / b of, the power of the return.
    double quality = 0.0;
};

/// The number of beams with an echo, which is the number of soundings of find_soundings().
int beams_with_sounding(const Ping& ping);

/// Makes one sounding per beam, in the order of the beams.
///
/// A beam is divided by the growth of the echo model's noise with range, so that the noise is
/// uniform. The range is the middle of its detect_return(); in the calibrated model, over oblique
/// ground, the place near it where both neighbouring beams are equally strong. The position lies on
/// the beam's axis, at elevation 0, by the water's profile of sound speed. If the sonar moves, the
/// azimuth is that at reception. `T_world_vehicle` is the pose of transmission.
std::vector<Sounding> find_soundings(const Sonar& sonar, const Pose& T_world_vehicle,
                                     const Ping& ping, const PingMotion& motion = {});

/// The bin of the bottom's first return in a column of range bins from near to far; nothing when
/// the column is dark. It is the leading edge: the first bin at which the running mean over three
/// bins, which suppresses single bright speckles, reaches half of its maximum.
std::optional<int> first_return(std::span<const float> column);

/// The range at which surface in a ping ends, behind which lie water and multipath; 0: none.
float farthest_surface_m(const TracedPing& traced);

/// A surface return detected in a beam: the run of bins [begin, end).
struct DetectedReturn {
    int begin = 0;
    int end = 0;          ///< equal to begin if nothing was detected
    double contrast = 0;  ///< sum over the run of (value - mean of the beam) / sqrt(length)
    double rival = 0;     ///< the greatest contrast of a run elsewhere; 0: none
};

/// Finds the run of bins of the greatest contrast. In white noise of unit variance, half of its
/// square is the log likelihood ratio of a surface of constant brightness.
DetectedReturn detect_return(std::span<const double> beam);

}  // namespace sonarsim
