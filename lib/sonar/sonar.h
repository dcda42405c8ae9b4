#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "ping/ping.h"
#include "scene/scene.h"
#include "surface/surface.h"

namespace sonarsim {

/// A sonar ready to ping: its configuration turned into what the pipeline works with.
struct Sonar {
    SonarConfig config;
    Pose T_vehicle_sensor;
    View view;
    std::uint32_t stream = 0;              ///< identifies the sonar in every random draw
    std::vector<double> range_edges_m;     ///< range_bins + 1
    std::vector<double> azimuth_edges_rad;  ///< beams + 1, from starboard (-) to port (+)
};

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy);

/// Which draw of the noise a ping gets; nothing else decides it.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// One ping, from what is visible to the finished image.
Ping render_ping(const Sonar& sonar, const Scene& scene, const Surface& surface,
                 const Pose& T_world_vehicle, const PingKey& key);

}  // namespace sonarsim
