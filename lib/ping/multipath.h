#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "ping/clusters.h"
#include "ping/ping.h"
#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// [1-3] for one sonar.
struct Multipath {
    bool on = false;
    ClusterLimits cluster;  ///< epsilon 0 is the exact method: every sample is traced by itself
};

/// Sound that came back by way of a sample and a second surface, and by how much it changes along
/// the half edges of the sample's footprint.
struct Bounce {
    std::uint32_t sample;  ///< index into Samples::items
    std::uint32_t second;  ///< the traced ray that found the second surface
    float range_m, range_u, range_v;
    float beam, beam_u, beam_v;  ///< in beams; its integer part is the beam
    float intensity;
};

/// Follows the sound that `samples` mirror to a second surface and from there to the sonar. The
/// first and the last sample of a cluster are traced; where they meet one plane, so do the others
/// [2], and where they do not, the others are traced as well. An echo has the azimuth of the second
/// point p, the range (|p_i| + |p - p_i| + |p|) / 2 and the intensity R_i R_h max(0, q . v_p).
/// Whether the sonar sees p is asked for the traced ones, for the others inherited. What is
/// rejected, and why, is counted.
std::vector<Bounce> find_bounces(const Multipath& multipath, const View& view,
                                 const Samples& samples, std::span<const Material> materials,
                                 const VisibilityEngine& engine, const Pose& T_world_sensor,
                                 MultipathCounts& counts);

}  // namespace sonarsim
