#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/range_boxes.h"

namespace sonarsim {

/// The echoes [begin, end) of a list.
struct EchoRange {
    std::uint32_t begin, end;
};

/// The parts of the echo of a beam's bins by source, such as an object.
struct BeamShares {
    /// The part of one source in the bins [first, last).
    struct Source {
        std::uint32_t key;
        int first, last;
        std::size_t offset;  ///< index of the bin `first` in `echo`
    };
    std::vector<Source> sources;  ///< several may have one key
    std::vector<float> echo;      ///< weight times intensity
    std::vector<float> weight;    ///< sum over all sources, by bin
    std::vector<float> total;     ///< echo of all sources, by bin
    int first = 0, last = 0;      ///< outside [first, last) no bin has an echo

    void clear(int bins);
    /// Adds the echoes of one source, spread over the bins as accumulate() does.
    void add(std::uint32_t key, const RangeBoxes& echoes, std::span<const EchoRange> ranges,
             const RangeBins& bins);

  private:
    BinSums sums_;  ///< 0 between calls
};

/// The largest and the second largest share of each bin of a beam.
struct TopTwo {
    std::vector<std::uint32_t> key;         ///< 1 + key of the source; 0: the bin has no echo
    std::vector<float> echo;                ///< its share
    std::vector<std::uint32_t> second_key;  ///< 0: no other key, or not asked for
    std::vector<float> second_echo;
    int first = 0, last = 0;  ///< outside [first, last) all is 0
    bool has_second = false;  ///< some of the second keys may not be 0

    void clear(int bins);
};

/// The number of the largest shares to find.
enum class Ranks { first, first_and_second };

/// Finds the keys with the largest parts in every bin. `key_of` maps the key of a source to the
/// wanted one, such as the class of an object; parts of one key are summed first. The lower key
/// wins among equal parts.
class TopTwoFinder {
  public:
    template <class KeyOf>
    void find(const BeamShares& shares, Ranks ranks, KeyOf key_of, TopTwo& out) {
        order_.clear();
        for (std::uint32_t k = 0; k < shares.sources.size(); ++k)
            order_.push_back({key_of(shares.sources[k].key), k});
        find_ordered(shares, ranks, out);
    }

  private:
    struct Entry {
        std::uint32_t key, source;
        auto operator<=>(const Entry&) const = default;  // NOLINT(modernize-use-nullptr)
    };

    void find_ordered(const BeamShares& shares, Ranks ranks, TopTwo& out);

    std::vector<Entry> order_;
    std::vector<float> sum_;  ///< sum of the sources with one key
};

}  // namespace sonarsim
