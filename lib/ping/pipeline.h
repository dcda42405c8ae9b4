#pragma once

#include <cstdint>

#include "core/pose.h"
#include "ping/multipath.h"
#include "ping/ping.h"
#include "ping/pixel_noise.h"
#include "ping/streaks.h"
#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// [7-8] for one sonar.
struct RangeNoise {
    float lambda_m = 0.0F;     ///< mean of the exponential; 0: none
    float scatterer_m = 0.0F;  ///< edge of the cells that share a draw
    bool fades = true;         ///< late echoes are weaker by exp(-w / lambda)
};

/// What the pipeline needs to know of a sonar.
struct PingSettings {
    View view;
    Multipath multipath;
    RangeNoise range_noise;
    PixelNoise pixel_noise;
    Streaks streaks;
    std::uint32_t stream = 0;  ///< names the sonar in every random draw
};

/// Which draw of the noise a ping gets.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// One ping, from what is visible to the finished image: the paper's section III.
Ping run_pipeline(const PingSettings& settings, const Scene& scene, const VisibilityEngine& engine,
                  const Pose& T_world_sensor, const PingKey& key);

}  // namespace sonarsim
