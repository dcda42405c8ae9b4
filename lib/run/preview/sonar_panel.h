#pragma once

#include <functional>

#include "simulate/assembly/assemble.h"
#include "simulate/product/picture.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

/// A sonar's picture around a ping.
struct SonarPanel {
    Picture picture;
    double white;  ///< intensity of the brightest colour
};

/// Renders a ping of the sonar by the index of its pose. It is called from several threads at once.
using RenderPing = std::function<Ping(std::uint32_t pose)>;

/// The last pose at or before `pose` at which the sonar pings.
std::uint32_t ping_at(const Sonar& sonar, std::uint32_t pose);

/// Draws at most `width` by `height` pixels: the fan of an imaging or profiling sonar with rings
/// and bearings, the display of a scanning sonar at that ping, the waterfall of a side-scan sonar
/// or the echogram of an echosounder around the ping, with two marks at the ping. The brightness is
/// derived from the shown pings.
SonarPanel draw_sonar(const Sonar& sonar, std::uint32_t pose, std::size_t poses,
                      const RenderPing& render, int width, int height);

}  // namespace sonarsim
