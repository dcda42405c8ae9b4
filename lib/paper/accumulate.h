#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paper/echoes.h"

namespace sonarsim {

/// The range bins of a ping: half-open, equal, from `min_m`.
struct RangeBins {
    float min_m = 0.0F;
    float bin_m = 0.0F;
    int count = 0;
};

/// The range bins of a view.
inline RangeBins range_bins(const View& view) {
    return {.min_m = static_cast<float>(view.range_min_m),
            .bin_m = static_cast<float>(view.bin_m()),
            .count = view.range_bins};
}

/// The sums that the boxes beginning in bin i add to it and to bin i + 1. They lie together, so
/// that a box costs one addition of four floats; additions to overlapping memory would wait for
/// each other.
struct alignas(16) BinSum {
    float weight;  ///< area, m^2
    float echo;    ///< area times intensity
    float next_weight;
    float next_echo;
};

/// The sums of one beam's bins, whose quotients are the means of Eq. 9.
struct BinSums {
    std::vector<BinSum> begins = {BinSum{}};  ///< indexed by bin + 1; the first one stays 0

    void clear(int bins);
    float weight(std::size_t bin) const { return begins[bin + 1].weight + begins[bin].next_weight; }
    float echo(std::size_t bin) const { return begins[bin + 1].echo + begins[bin].next_echo; }
};

/// Adds every echo to the bins that its box in range covers, in proportion to the overlap. Parts
/// outside the range are dropped. Returns how many echoes lay wholly outside.
std::uint64_t accumulate(const Echoes& echoes, const RangeBins& bins, BinSums& sums);

/// The same for the echoes [begin, end).
std::uint64_t accumulate(const Echoes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums);

/// Sets `occupied` to 1 in the bins to which accumulate() would add weight. It has one place more
/// than there are bins, which stays 0.
void mark_lit(const Echoes& echoes, std::size_t begin, std::size_t end, const RangeBins& bins,
              std::span<std::uint8_t> occupied);

/// The area-weighted mean of each bin, Eq. 9; 0 where it saw no surface. Returns how many did.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity);

/// Writes the means of `beams` beams, `by_beam` [beams, range bins], into as many columns of
/// `image`, [range bins, columns], from the column `first` on.
void write_beams(std::span<const float> by_beam, int beams, int first, int columns,
                 std::span<float> image);

}  // namespace sonarsim
