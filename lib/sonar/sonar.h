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

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy);

/// What the sonar sees from a pose of its vehicle.
TracedPing trace(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const Terms& terms = {});

/// Traces a ping and forms its image.
Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key, const Terms& terms = {});

/// A traced ping with one term of the model after the other, `term_by_term`. The last is the ping
/// itself. A term that the sonar does not use changes nothing.
std::array<Ping, 5> form_stages(const TracedPing& traced, const Sonar& sonar, const Scene& scene,
                                const PingKey& key);

}  // namespace sonarsim
