#pragma once

#include "simulate/product/strip.h"

namespace sonarsim {

// The waterfall of a side-scan sonar as an operator sees it, in copper tones: a range axis, then a
// row per ping, the first ping on top, port on the left. It is one pixel wider than the row of the
// record (sidescan_row.h), for the line at nadir.

StripFrame waterfall_frame(const SonarConfig& config, int pings);
/// The range axis, metres on either side of nadir.
Picture waterfall_axis(const SonarConfig& config, const StripFrame& frame);
void waterfall_row(std::span<const float> row, double white, const StripFrame& frame,
                   std::span<Rgb> pixels);

inline constexpr StripStyle waterfall_style{waterfall_frame, waterfall_axis, waterfall_row};

}  // namespace sonarsim
