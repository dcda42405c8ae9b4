#pragma once

#include <span>

#include "mission/mission.h"
#include "product/picture.h"

namespace sonarsim {

// The waterfall as an operator sees it, in copper tones: a range axis, then a row per ping, the
// first ping on top, port on the left. It is one pixel wider than the waterfall's row
// (sidescan_row.h), for the line at nadir.

/// Draws the strip with the range axis, metres on either side of nadir.
Picture waterfall_axis(const SonarConfig& config);

/// Draws one row of the waterfall; `pixels` has one more element than `row`. `white` is the
/// intensity of the brightest colour.
void waterfall_row(std::span<const float> row, double white, std::span<Rgb> pixels);

}  // namespace sonarsim
