#pragma once

#include <optional>

#include "simulate/ping/sonar.h"
#include "simulate/product/picture.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

/// The depth in an echosounder's ping, m: slant range of the bottom's leading edge, the middle of
/// its bin (first_return() in simulate/product/bottom.h). Nothing when the ping is dark.
std::optional<double> detected_depth(const Sonar& sonar, const Ping& ping);

// The echogram as an operator sees it: a depth axis on the left, then a column per ping, the
// nearest range on top. Each bin is a rectangle of pixels, so that short missions are legible.

StripFrame echogram_frame(const SonarConfig& config, int pings);
/// The depth axis, metres.
Picture echogram_axis(const SonarConfig& config, const StripFrame& frame);
/// A range bin over all pings.
void echogram_row(std::span<const float> bins, double white, const StripFrame& frame,
                  std::span<Rgb> pixels);

inline constexpr StripStyle echogram_style{echogram_frame, echogram_axis, echogram_row};

}  // namespace sonarsim
