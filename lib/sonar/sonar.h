#pragma once

#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "ping/pipeline.h"

namespace sonarsim {

/// A sonar ready to ping: its configuration turned into what the pipeline works with.
struct Sonar {
    SonarConfig config;
    Pose T_vehicle_sensor;
    PingSettings settings;
    std::vector<double> range_edges_m;      ///< range_bins + 1
    std::vector<double> azimuth_edges_rad;  ///< beams + 1, from starboard (-) to port (+)
};

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy);

Ping render_ping(const Sonar& sonar, const Scene& scene, const Surface& surface,
                 const Pose& T_world_vehicle, const PingKey& key);

}  // namespace sonarsim
