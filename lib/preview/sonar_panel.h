#pragma once

#include <functional>
#include <vector>

#include "assembly/assemble.h"
#include "product/picture.h"
#include "trace/ping.h"

namespace sonarsim {

/// What a sonar shows around a ping.
struct SonarPanel {
    Picture picture;
    double white;  ///< the intensity that is shown brightest
};

/// Renders a ping of the sonar by the index of its pose; called from several threads at a time.
using RenderPing = std::function<Ping(std::uint32_t pose)>;

/// The last pose at or before `pose` at which the sonar pings.
std::uint32_t ping_at(const Sonar& sonar, std::uint32_t pose);

/// At most `width` by `height` pixels. Of an imaging or profiling sonar the fan with rings and
/// bearings; of a scanning one the scan as it stands then; of a side-scan sonar the waterfall and
/// of an echosounder the echogram of the pings around, with two marks at the ping itself. The
/// brightness finds itself.
SonarPanel draw_sonar(const Sonar& sonar, std::uint32_t pose, std::size_t poses,
                      const RenderPing& render, int width, int height);

}  // namespace sonarsim
