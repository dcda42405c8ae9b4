#pragma once

#include <array>

#include "core/pose.h"
#include "mission/mission.h"
#include "ping/sonar.h"

namespace sonarsim {

/// A sonar of the kind that its configuration names, see sonar/kinds.h.
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
