#pragma once

#include <vector>

#include "simulate/trace/bounce_path.h"
#include "simulate/trace/clusters.h"
#include "simulate/trace/counters.h"
#include "simulate/trace/trace_context.h"

namespace sonarsim {

/// The settings of a sonar's multipath, Eq. 1-3 and Algorithm 1.
struct Multipath {
    bool on = false;
    ClusterLimits cluster;  ///< epsilon 0 is the exact method: every sample is traced by itself
    /// Keeps paths that the second surface reflects away from the sonar.
    bool scattered = false;
};

/// Follows the sound that `samples` reflect to a second surface h and from there to the sonar. The
/// first and the last sample of a cluster are traced. Where both hit one plane, the others are
/// reflected off it (Eq. 2); where they do not, the others are traced as well. An echo has the
/// azimuth of the second point p, the range (|p_i| + |p - p_i| + |p|) / 2 (Eq. 3; the paper prints
/// |p_i| as the last term) and the intensity R_i R_h max(0, q . v_p). For a traced sample a ray
/// tests whether the sonar sees p; the others of its cluster inherit the result. Samples without an
/// echo are counted by the reason. For a sonar below the water's surface, the water's surface is a
/// second surface, too. Sound that it reflects is followed to the image of the next surface; over a
/// flat bottom this is the second bottom echo.
std::vector<BouncePath> find_bounces(const Multipath& multipath, const TraceContext& context,
                                     const Samples& samples, MultipathCounts& counts);

}  // namespace sonarsim
