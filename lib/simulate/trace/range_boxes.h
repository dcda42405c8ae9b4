#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "simulate/visibility/view.h"

namespace sonarsim {

struct Sample;

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

/// Echoes of surface, spread evenly over [range - half, range + half]; arrays, for vector loops.
struct RangeBoxes {
    std::vector<float> range_m;    ///< slant range of the middle of the extent
    std::vector<float> half_m;     ///< half its extent in range
    std::vector<float> weight;     ///< the unit is the echo model's: the paper's is area, m^2
    std::vector<float> intensity;  ///< its echo is weight times intensity

    std::size_t size() const { return range_m.size(); }
    void resize(std::size_t count);
};

/// The sums that the boxes beginning in bin i add to it and to bin i + 1. They lie together, so
/// that a box costs one addition of four floats; overlapping additions would wait for each other.
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

/// Echoes as in RangeBoxes, each in a beam and from a sample.
struct EchoBlock {
    static constexpr int capacity = 256;

    int count = 0;
    bool multipath = false;     ///< all came over a second surface; samples reflect the sound
    bool behind_walls = false;  ///< all came through walls: their bins may lie in a shadow
    std::array<float, capacity> range_m, half_m, weight, intensity;
    std::array<std::uint32_t, capacity> beam;
    std::array<const Sample*, capacity> sample;
    std::array<std::uint32_t, capacity> second;  ///< BouncePath::instance of multipath
};

/// Sums of echoes by source, beam and range bin. Boxes are spread over the bins as by accumulate().
class EchoSums {
  public:
    EchoSums(const RangeBins& bins, int beams);

    /// `sources`: one for each echo, numbers from 0 on.
    void add(const EchoBlock& echoes, std::span<const std::uint32_t> sources);

    /// One more than the greatest source with an echo.
    std::uint32_t sources() const { return static_cast<std::uint32_t>(rows_.size()); }
    /// Adds the echo of a source to `total` [range bins]. False: the beam receives none of it.
    bool add_to(std::uint32_t source, int beam, std::span<float> total) const;
    /// 1 for the bins with weight that came through no wall, else 0.
    std::span<const std::uint8_t> occupied(int beam) const {
        return std::span(occupied_).subspan(beam * stride_, stride_ - 1);
    }

  private:
    /// The sums that the boxes beginning in a bin add to it and to the next one.
    struct Sum {
        float echo, next;
    };
    using Row = std::unique_ptr<Sum[]>;

    RangeBins bins_;
    std::size_t beams_, stride_;
    std::vector<std::vector<Row>> rows_;  ///< [source][beam]; null: no echo
    std::vector<std::uint8_t> occupied_;  ///< [beams][stride]; the last one of a beam stays 0
    std::vector<std::uint8_t> unused_;    ///< [stride] in its place for echoes through walls
};

}  // namespace sonarsim
