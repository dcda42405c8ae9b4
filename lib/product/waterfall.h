#pragma once

#include <span>

#include "mission/mission.h"
#include "product/picture.h"

namespace sonarsim {

// The waterfall as an operator sees it, in copper tones: a range axis, then a row per ping, the
// first ping on top, port on the left. It is a pixel wider than the waterfall's row
// (sidescan_row.h), for the line at nadir that stands between the two sides.

/// The strip with the range axis, metres on either side of nadir.
Picture waterfall_axis(const SonarConfig& config);

/// One row of the waterfall, of a value less than pixels. `white` is the intensity that is shown
/// brightest.
void waterfall_row(std::span<const float> row, double white, std::span<Rgb> pixels);

}  // namespace sonarsim
