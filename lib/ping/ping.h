#pragma once

#include <cstdint>
#include <vector>

namespace sonarsim {

/// Of the samples of a ping, what became of them as sources of multipath.
struct MultipathCounts {
    std::uint64_t samples = 0;  ///< within the range
    std::uint64_t clusters = 0;
    std::uint64_t rays = 0;         ///< traced for them, and back to the sonar
    std::uint64_t bounces = 0;      ///< samples whose sound came back; the others:
    std::uint64_t missed = 0;       ///< met no second surface
    std::uint64_t edge_on = 0;      ///< run along the second plane
    std::uint64_t behind = 0;       ///< leave the second plane
    std::uint64_t outside = 0;      ///< met it outside the field of view, or beyond the range
    std::uint64_t turned_away = 0;  ///< were mirrored away from the sonar
    std::uint64_t hidden = 0;       ///< met what the sonar does not see
};

/// What a ping counted on its way, for the metadata.
struct PingCounts {
    std::uint64_t samples = 0;          ///< pieces of surface seen
    std::uint64_t dropped_samples = 0;  ///< besides these, left out: Samples::dropped
    std::uint64_t echoes = 0;           ///< footprints that were added into bins
    std::uint64_t out_of_range = 0;     ///< of these, dropped: wholly outside the range
    std::uint64_t occupied_bins = 0;    ///< bins that saw surface
    std::uint64_t negative_pixels = 0;  ///< set to 0 after the pixel noise
    std::uint64_t streak_rows = 0;      ///< changed by a streak
    MultipathCounts multipath;
};

/// Seconds spent in the stages of a ping.
struct PingSeconds {
    double trace = 0.0;
    double multipath = 0.0;
    double accumulate = 0.0;  ///< range noise and binning
    double noise = 0.0;       ///< pixel noise and streaks
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
