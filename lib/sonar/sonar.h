#pragma once

#include <array>
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
    std::vector<double> azimuth_edges_rad;  ///< of a fan: beams + 1, from starboard (-) to port (+)
};

/// Whether a ping is an image of its own, range by azimuth, and not a row or column of a longer one.
bool has_images(const Sonar& sonar);

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy);

/// One ping with one term of the model after the other, as in the paper's Fig. 5(d): direct echoes,
/// plus multipath, plus range noise, plus pixel noise, plus streaks. The last is the ping itself. A
/// term that the sonar does not use changes nothing.
std::array<Ping, 5> render_stages(const Sonar& sonar, const Scene& scene,
                                  const VisibilityEngine& engine, const Pose& T_world_vehicle,
                                  const PingKey& key);

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key);

}  // namespace sonarsim
