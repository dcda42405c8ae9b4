#pragma once

#include <compare>
#include <cstdint>
#include <memory>

#include "simulate/assembly/assemble.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

/// A ping of a dataset: sensor by its index in Mission::sensors, pose by its index on the
/// trajectory. Ordered by pose, then sensor.
struct PingId {
    std::uint32_t pose = 0;
    std::uint32_t sensor = 0;

    auto operator<=>(const PingId&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// A ping of a mission, and the sonar and the engine that it was made with.
struct RenderedPing {
    PingId id;
    SonarAtPose sonar;
    std::shared_ptr<const VisibilityEngine> engine;  ///< the scene at the time of the ping
    TracedPing traced;
    Ping ping;
};

/// Traces a ping and forms its image. The mission, the assembly and `engine` must outlive it.
RenderedPing render_at_pose(const Mission& mission, const Assembly& assembly,
                            const VisibilityEngine& engine, const PingId& id);

}  // namespace sonarsim
