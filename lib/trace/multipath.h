#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "trace/clusters.h"
#include "trace/mirrored_pieces.h"
#include "trace/ping.h"
#include "visibility/engine.h"

namespace sonarsim {

/// How a sonar finds multipath, Eq. 1-3 and Algorithm 1.
struct Multipath {
    bool on = false;
    ClusterLimits cluster;  ///< epsilon 0 is the exact method: every sample is traced by itself
};

/// An echo by way of a sample and a second surface, and by how much it changes along the half edges
/// of the sample's footprint.
struct Bounce {
    std::uint32_t sample;  ///< index into Samples::items
    std::uint32_t second;  ///< the traced ray that found the second surface
    float range_m, range_u, range_v;
    float beam, beam_u, beam_v;  ///< in beams; its integer part is the beam
    float intensity;
};

/// Follows the sound that `samples` mirror to a second surface h and from there to the sonar. The
/// first and the last sample of a cluster are traced. Where both hit one plane, the others are
/// reflected off it (Eq. 2); where they do not, the others are traced as well. An echo has the
/// azimuth of the second point p, the range (|p_i| + |p - p_i| + |p|) / 2 (Eq. 3, whose print ends
/// in |p_i|) and the intensity R_i R_h max(0, q . v_p). For a traced sample a ray finds out whether
/// the sonar sees p; the others of its cluster inherit the answer. Samples without an echo are
/// counted by what became of them. For a sonar below the water's surface, that is a second surface,
/// too; and the sound that it mirrors is followed to the next one, as if that lay in the mirror:
/// with a flat bottom that is the second bottom echo.
///
/// For the calibrated model `mirrored` takes what is seen by way of the samples. A second surface
/// that scatters sends sound back all round, so that what is turned away (q . v_p <= 0), of which
/// there is no Bounce, is there as well; of the water's surface there is nothing.
std::vector<Bounce> find_bounces(const Multipath& multipath, const View& view,
                                 const Samples& samples, std::span<const Material> materials,
                                 const VisibilityEngine& engine, const Pose& T_world_sensor,
                                 MultipathCounts& counts,
                                 const std::optional<WaterSurface>& surface = std::nullopt,
                                 std::vector<MirroredPiece>* mirrored = nullptr);

}  // namespace sonarsim
