#include "labels/shares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonarsim {

namespace {

struct Reach {
    int first, last;  ///< bins [first, last)
};

/// The bins that echoes can reach. Echoes with NaN reach none.
Reach reach_of(const RangeBoxes& echoes, std::span<const EchoRange> ranges, const RangeBins& bins) {
    float low = bins.min_m + bins.bin_m * static_cast<float>(bins.count);
    float high = bins.min_m;
    for (const EchoRange& range : ranges) {
        for (std::uint32_t k = range.begin; k < range.end; ++k) {
            low = std::min(low, echoes.range_m[k] - echoes.half_m[k]);
            high = std::max(high, echoes.range_m[k] + echoes.half_m[k]);
        }
    }
    // One bin more on either side, since accumulate() rounds differently and widens an echo without
    // depth.
    const auto count = static_cast<float>(bins.count);
    const float per_bin = 1.0F / bins.bin_m;
    const float first = std::clamp((low - bins.min_m) * per_bin - 1.0F, 0.0F, count);
    const float last = std::clamp((high - bins.min_m) * per_bin + 2.0F, first, count);
    return {static_cast<int>(first), static_cast<int>(last)};
}

/// Merges one key's echoes of `count` bins into the two largest.
void keep_top_two(const float* __restrict echo, int count, std::uint32_t id,
                  std::uint32_t* __restrict best, float* __restrict best_echo,
                  std::uint32_t* __restrict second, float* __restrict second_echo) {
    for (int i = 0; i < count; ++i) {
        const float e = echo[i];
        const bool first = e > best_echo[i];
        const bool next = e > second_echo[i];
        const float lower = next ? e : second_echo[i];
        const std::uint32_t lower_id = next ? id : second[i];
        second_echo[i] = first ? best_echo[i] : lower;
        second[i] = first ? best[i] : lower_id;
        best_echo[i] = first ? e : best_echo[i];
        best[i] = first ? id : best[i];
    }
}

/// The same for the largest alone.
void take_largest(const float* __restrict echo, int count, std::uint32_t id,
                  std::uint32_t* __restrict best, float* __restrict best_echo) {
    for (int i = 0; i < count; ++i) {
        const bool first = echo[i] > best_echo[i];
        best_echo[i] = first ? echo[i] : best_echo[i];
        best[i] = first ? id : best[i];
    }
}

}  // namespace

void BeamShares::clear(int bins) {
    sources.clear();
    echo.clear();
    if (std::ssize(total) != bins) {
        weight.assign(bins, 0.0F);
        total.assign(bins, 0.0F);
        sums_.clear(bins);
    } else {
        std::fill(weight.begin() + first, weight.begin() + last, 0.0F);
        std::fill(total.begin() + first, total.begin() + last, 0.0F);
    }
    first = last = 0;
}

void BeamShares::add(std::uint32_t key, const RangeBoxes& echoes, std::span<const EchoRange> ranges,
                     const RangeBins& bins) {
    const Reach reach = reach_of(echoes, ranges, bins);
    if (reach.first >= reach.last) return;
    for (const EchoRange& range : ranges)
        accumulate(echoes, range.begin, range.end, bins, sums_);
    const std::size_t offset = echo.size();
    const int count = reach.last - reach.first;
    echo.resize(offset + count);
    const BinSum* const __restrict begins = sums_.begins.data() + reach.first;
    float* const __restrict own = echo.data() + offset;
    float* const __restrict all = total.data() + reach.first;
    float* const __restrict area = weight.data() + reach.first;
    for (int i = 0; i < count; ++i) {
        own[i] = begins[i + 1].echo + begins[i].next_echo;
        all[i] += own[i];
        area[i] += begins[i + 1].weight + begins[i].next_weight;
    }
    // Echoes out of range add 0 to the first bin and need no clearing.
    std::fill(sums_.begins.begin() + reach.first, sums_.begins.begin() + reach.last + 1, BinSum{});
    first = sources.empty() ? reach.first : std::min(first, reach.first);
    last = std::max(last, reach.last);
    sources.push_back({key, reach.first, reach.last, offset});
}

void TopTwo::clear(int bins) {
    const auto blank = [&](auto& values) {
        if (std::ssize(values) == bins) {
            std::fill(values.begin() + first, values.begin() + last, 0);
        } else {
            values.assign(bins, 0);
        }
    };
    blank(key);
    blank(echo);
    if (!has_second && std::ssize(second_key) == bins) return;
    blank(second_key);
    blank(second_echo);
    has_second = false;
}

void TopTwoFinder::find_ordered(const BeamShares& shares, Ranks ranks, TopTwo& out) {
    out.clear(static_cast<int>(shares.total.size()));
    out.first = shares.first;
    out.last = shares.last;
    out.has_second = ranks == Ranks::first_and_second;
    std::ranges::sort(order_);
    for (std::size_t a = 0, b = 0; a < order_.size(); a = b) {
        const BeamShares::Source& source = shares.sources[order_[a].source];
        int first = source.first;
        int last = source.last;
        for (b = a + 1; b < order_.size() && order_[b].key == order_[a].key; ++b) {
            first = std::min(first, shares.sources[order_[b].source].first);
            last = std::max(last, shares.sources[order_[b].source].last);
        }
        const float* echo = shares.echo.data() + source.offset;
        if (b > a + 1) {
            sum_.assign(last - first, 0.0F);
            for (std::size_t k = a; k < b; ++k) {
                const BeamShares::Source& part = shares.sources[order_[k].source];
                for (int i = part.first; i < part.last; ++i)
                    sum_[i - first] += shares.echo[part.offset + i - part.first];
            }
            echo = sum_.data();
        }
        if (ranks == Ranks::first) {
            take_largest(echo, last - first, order_[a].key + 1, out.key.data() + first,
                         out.echo.data() + first);
        } else {
            keep_top_two(echo, last - first, order_[a].key + 1, out.key.data() + first,
                         out.echo.data() + first, out.second_key.data() + first,
                         out.second_echo.data() + first);
        }
    }
}

}  // namespace sonarsim
