#pragma once

#include <optional>
#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "product/picture.h"
#include "trace/ping.h"

namespace sonarsim {

/// The depth in an echosounder's ping, m: slant range of the bottom's leading edge, the middle of
/// its bin (first_return() in product/bottom.h). Nothing when the ping is dark.
std::optional<double> detected_depth(const Sonar& sonar, const Ping& ping);

// The echogram as an operator sees it: a depth axis on the left, then a column per ping, the
// nearest range on top. Each bin is a rectangle of pixels, so that short missions are legible.

struct EchogramFrame {
    int axis_width = 0;    ///< px
    int ping_width = 1;    ///< px per ping
    int range_height = 1;  ///< px per bin
    int width = 0;         ///< px, with the axis
    int height = 0;
};
EchogramFrame echogram_frame(const SonarConfig& config, int pings);

/// Draws the strip with the depth axis, metres.
Picture echogram_axis(const SonarConfig& config, const EchogramFrame& frame);

/// Draws the pixels of one range bin over all pings, without the axis. `white` is the intensity of
/// the brightest colour.
void echogram_row(std::span<const float> bins, double white, int ping_width, std::span<Rgb> pixels);

}  // namespace sonarsim
