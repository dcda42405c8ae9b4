#pragma once

#include <cstdint>

#include "trace/ping.h"

namespace sonarsim {

/// What the pings of one sonar came to in a run.
struct SensorSummary {
    std::uint64_t pings = 0;
    std::uint64_t dark_pings = 0;  ///< without a bin that saw surface
    PingCounts counts;             ///< summed over the pings
    std::uint64_t clipped_pixels = 0;
    std::uint64_t missed_goals = 0;  ///< pings whose estimated error is above the goal
    double worst_l1 = 0.0;           ///< the greatest of the estimates
    float brightest = 0.0F;          ///< intensity of the brightest pixel of all
};

}  // namespace sonarsim
