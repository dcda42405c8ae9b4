#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "simulate/trace/counters.h"

namespace sonarsim {

/// One ping of one sonar: the image, row by row.
struct Ping {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], 0 where nothing is seen
    PingCounts counts;
    PingSeconds seconds;

    float at(int range_bin, int beam) const {
        return intensity[static_cast<std::size_t>(range_bin) * beams + beam];
    }
};

/// The random draws of one ping of one sonar.
struct PingDraws {
    std::uint64_t seed = 0;
    std::uint32_t sensor = 0;  ///< names the sonar
    std::uint32_t ping = 0;    ///< index of the pose on the trajectory

    PhiloxKey of(Stream stream) const { return stream_key(seed, sensor, ping, stream); }
    /// Draws that belong to the scene: the same for all sonars and pings.
    PhiloxKey of_scene(Stream stream) const { return stream_key(seed, 0, 0, stream); }
};

}  // namespace sonarsim
