#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "ping/sonar.h"

namespace sonarsim {

/// A sonar of the kind that its configuration names, see sonar/kinds.h.
/// `water` is what the calibrated model works with.
Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                 const WaterConfig& water = {});

/// The sonar as it is at a pose, with what the mission's `vary` draws for every ping; nothing where
/// that is nothing of this sonar.
std::optional<Sonar> drawn_sonar(const Mission& mission, const Sonar& sonar, std::uint32_t pose);

/// What the sonar sees from a pose of its vehicle; `pose` is the pose's index on the trajectory, by
/// which a head turns.
TracedPing trace(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, std::uint32_t pose, const Terms& terms = {});

/// Traces a ping and forms its image.
Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key, const Terms& terms = {});

/// The stages of the sonar's echo model, see terms_at_stage().
std::size_t stage_count(const Sonar& sonar);

/// The images of a traced ping at the stages of the sonar's echo model. The last is the ping
/// itself. A term that the sonar does not use changes nothing.
std::vector<Ping> form_stages(const TracedPing& traced, const Sonar& sonar, const Scene& scene,
                              const PingKey& key);

}  // namespace sonarsim
