#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/pose.h"
#include "paper/pixel_noise.h"
#include "paper/range_noise.h"
#include "paper/streaks.h"
#include "ping/terms.h"
#include "scene/scene.h"
#include "trace/multipath.h"
#include "trace/ping.h"
#include "visibility/engine.h"

namespace sonarsim {

struct CalibratedModel;

/// What the pipeline needs to know of a sonar, stage by stage.
struct PingSettings {
    View view;
    /// Of a calibrated fan: beams of azimuth to either side of the view in which surface is looked
    /// for as well. A line array's beam is a cone, which reaches there far off the horizontal
    /// plane.
    int beams_beside = 0;
    Multipath multipath;
    RangeNoise range_noise;
    PixelNoise pixel_noise;
    Streaks streaks;
    /// The second model, docs/calibrated.md: then of the stages above view and multipath alone are
    /// used. Null: the paper's.
    std::shared_ptr<const CalibratedModel> calibrated;
    std::uint32_t stream = 0;  ///< names the sonar in every random draw
};

/// Which draw of the noise a ping gets.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// What a sonar saw from one pose. It knows nothing of noise: any number of images may be formed
/// from it.
struct TracedPing {
    Pose T_world_sensor;
    Samples samples;                      ///< the visible surface
    std::vector<Sample> beside;           ///< and that in the beams beside the view
    std::vector<Bounce> bounces;          ///< multipath by way of it
    std::vector<MirroredPiece> mirrored;  ///< the same as the calibrated model takes it
    PingCounts counts;
    PingSeconds seconds;
};

/// Finds the surface that a sonar sees and, if its settings and the terms have it, the multipath:
/// steps 1 and 2 of docs/model.md.
TracedPing trace_ping(const PingSettings& settings, const Scene& scene,
                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                      const Terms& terms = {});

/// Finds the multipath of a traced ping anew, as `settings` have it.
void trace_multipath(const PingSettings& settings, const Scene& scene,
                     const VisibilityEngine& engine, TracedPing& traced);

/// The image of a traced ping with those of the terms that the settings have: steps 3 to 7 of
/// docs/model.md. A pure function: the same arguments give the same bytes. `settings` may differ
/// from those that the ping was traced with in all but the view. The ping counts and times the
/// tracing as well; of multipath only what is in the image.
Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms = {});

}  // namespace sonarsim
