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

/// The sums behind the mean [9] of one beam's bins.
struct BinSums {
    std::vector<float> weight;  ///< area, m^2
    std::vector<float> echo;    ///< area times intensity

    void clear(int bins);
};

/// Adds every echo to the bins that its box in range covers, in proportion to the overlap. What
/// lies outside the range is dropped. Returns how many echoes lay outside as a whole.
std::uint64_t accumulate(const Echoes& echoes, const RangeBins& bins, BinSums& sums);

/// The same for the echoes [begin, end).
std::uint64_t accumulate(const Echoes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums);

/// [9]: the area-weighted mean of each bin, 0 where it saw no surface. Returns the occupied bins.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity);

}  // namespace sonarsim
