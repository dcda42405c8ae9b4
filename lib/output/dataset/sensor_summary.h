#pragma once

#include <algorithm>
#include <cstdint>

#include "simulate/trace/ping.h"

namespace sonarsim {

/// Sums over pings of one sonar.
struct SensorSummary {
    std::uint64_t pings = 0;
    std::uint64_t dark_pings = 0;  ///< pings without an occupied bin
    PingCounts counts;
    std::uint64_t clipped_pixels = 0;  ///< intensities above full_scale, if files were written
    float brightest = 0.0F;            ///< intensity of the brightest pixel of all

    SensorSummary& operator+=(const SensorSummary& more) {
        pings += more.pings;
        dark_pings += more.dark_pings;
        counts += more.counts;
        clipped_pixels += more.clipped_pixels;
        brightest = std::max(brightest, more.brightest);
        return *this;
    }
};

}  // namespace sonarsim
