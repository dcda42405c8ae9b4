#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ping/echoes.h"

namespace sonarsim {

/// The range bins of a ping: half-open, equal, from `min_m`.
struct RangeBins {
    float min_m = 0.0F;
    float bin_m = 0.0F;
    int count = 0;
};

/// The sums of one beam's bins, whose quotient is the mean of Eq. 9.
struct BinSums {
    std::vector<float> weight;  ///< area, m^2
    std::vector<float> echo;    ///< area times intensity

    void clear(int bins);
};

/// Adds every echo to the bins that its box in range covers, in proportion to the overlap. Parts
/// outside the range are dropped. Returns how many echoes lay wholly outside.
std::uint64_t accumulate(const Echoes& echoes, const RangeBins& bins, BinSums& sums);

/// The same for the echoes [begin, end).
std::uint64_t accumulate(const Echoes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums);

/// The area-weighted mean of each bin, Eq. 9; 0 where it saw no surface. Returns how many did.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity);

/// The means of all beams, [beams, range bins], as an image, [range bins, beams].
std::vector<float> image_of_beams(std::span<const float> by_beam, int range_bins, int beams);

}  // namespace sonarsim
