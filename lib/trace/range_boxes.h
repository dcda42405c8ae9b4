#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/view.h"

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

/// Echoes of pieces of surface, each spread evenly over [range - half, range + half]. Arrays, so
/// that loops vectorise.
struct RangeBoxes {
    std::vector<float> range_m;    ///< slant range of the middle of the extent
    std::vector<float> half_m;     ///< half its extent in range
    std::vector<float> weight;     ///< the unit is the echo model's: the paper's is area, m^2
    std::vector<float> intensity;  ///< its echo is weight times intensity

    std::size_t size() const { return range_m.size(); }
    void resize(std::size_t count);
};

/// The sums that the boxes beginning in bin i add to it and to bin i + 1. They lie together, so
/// that a box costs one addition of four floats; additions to overlapping memory would wait for
/// each other.
struct alignas(16) BinSum {
    float weight;
    float echo;  ///< weight times intensity
    float next_weight;
    float next_echo;
};

/// The sums of one beam's bins.
struct BinSums {
    std::vector<BinSum> begins = {BinSum{}};  ///< indexed by bin + 1; the first one stays 0
    /// The bins [first, end) that boxes were added to; the sums of all others are 0.
    int first = 0;
    int end = 0;

    void clear(int bins);
    /// Notes that boxes are added to the bins [from, to).
    void include(int from, int to);
    float weight(std::size_t bin) const { return begins[bin + 1].weight + begins[bin].next_weight; }
    float echo(std::size_t bin) const { return begins[bin + 1].echo + begins[bin].next_echo; }
};

/// Adds every echo to the bins that its box in range covers, in proportion to the overlap. Parts
/// outside the range are dropped. Returns the number of echoes wholly outside.
std::uint64_t accumulate(const RangeBoxes& echoes, const RangeBins& bins, BinSums& sums);

/// The same for the echoes [begin, end).
std::uint64_t accumulate(const RangeBoxes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums);

/// Sets `occupied` to 1 in the bins to which accumulate() would add weight. `occupied` has one
/// element more than there are bins, which stays 0.
void mark_occupied(const RangeBoxes& echoes, std::size_t begin, std::size_t end,
                   const RangeBins& bins, std::span<std::uint8_t> occupied);

}  // namespace sonarsim
