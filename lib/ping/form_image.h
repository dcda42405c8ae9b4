#pragma once

#include <cstdint>
#include <memory>

#include "trace/echo_model.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// What a ping of a sonar is traced and formed with.
struct PingSettings : TraceSettings {
    std::shared_ptr<const EchoModel> model;
    std::uint32_t stream = 0;  ///< names the sonar in every random draw
};

/// Which draw of the noise a ping gets.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// The image of a traced ping by the sonar's echo model, with those of the terms that the settings
/// have. A pure function: the same arguments give the same bytes. `settings` may differ from those
/// that the ping was traced with in all but the view. The ping counts and times the tracing as
/// well; of multipath only what is in the image.
Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms = {});

}  // namespace sonarsim
