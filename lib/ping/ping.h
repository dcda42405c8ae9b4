#pragma once

#include <cstdint>
#include <vector>

namespace sonarsim {

/// What a ping counted on its way, for the metadata.
struct PingCounts {
    std::uint64_t samples = 0;          ///< pieces of surface seen
    std::uint64_t echoes = 0;           ///< footprints that were added into bins
    std::uint64_t out_of_range = 0;     ///< of these, dropped: wholly outside the range
    std::uint64_t occupied_bins = 0;    ///< bins that saw surface
    std::uint64_t negative_pixels = 0;  ///< set to 0 after the pixel noise
};

/// Seconds spent in the stages of a ping.
struct PingSeconds {
    double trace = 0.0;
    double accumulate = 0.0;  ///< range noise and binning
    double noise = 0.0;       ///< pixel noise
};

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

}  // namespace sonarsim
