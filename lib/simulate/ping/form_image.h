#pragma once

#include <cstdint>
#include <memory>

#include "simulate/trace/echo_model.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// The settings of a sonar for the trace and the image of a ping.
struct PingSettings : TraceSettings {
    std::shared_ptr<const EchoModel> model;
    std::uint32_t stream = 0;  ///< names the sonar in every random draw
};

/// The key of the random draws of a ping.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// Forms the image of a traced ping by the sonar's echo model, with the terms that are in both
/// `terms` and the settings. A pure function: the same arguments give the same bytes. `settings`
/// may differ from those of the trace except for the view. The counts and the times of the ping
/// include the trace; its multipath is counted only if it is in the image. A ping of several groups
/// of beams has their mean counts and the sum of their times.
Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms = {});

}  // namespace sonarsim
