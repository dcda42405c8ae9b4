#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "trace/counters.h"

namespace sonarsim {

/// One ping of one sonar: the image, row by row.
struct Ping {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], 0 where nothing is seen
    /// What the engine thinks of its own error, see Samples::estimated_l1.
    double estimated_l1 = std::numeric_limits<double>::quiet_NaN();
    PingCounts counts;
    PingSeconds seconds;

    float at(int range_bin, int beam) const {
        return intensity[static_cast<std::size_t>(range_bin) * beams + beam];
    }
};

}  // namespace sonarsim
