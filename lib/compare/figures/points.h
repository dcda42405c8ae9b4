#pragma once

#include <vector>

#include "compare/figures/patches.h"

namespace sonarsim {

/// The echo of a point that stands alone: a bin that is the largest within 4 ranges and 12 beams
/// and 150 times (22 dB) the median of the 7 ranges about it.
struct PointEcho {
    int range = 0;
    int beam = 0;
    double width_beams = 0.0;  ///< at half of the power, between bins linearly
    double width_ranges = 0.0;
    double side_lobes_db = 0.0;  ///< mean power 5 to 8 beams away over the point's
};

/// The point echoes with ranges in [from, to), at least 20 beams, or an eighth of the fan, away
/// from its edges.
std::vector<PointEcho> point_echoes(const ImageView& image, int from, int to);

}  // namespace sonarsim
