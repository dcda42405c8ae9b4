#include "simulate/trace/range_boxes.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

constexpr std::size_t boxes_per_block = 64;

struct Pair {
    float first, second;
};

/// The boxes of a block of echoes.
struct Boxes {
    std::array<int, boxes_per_block> first, last;   ///< bin
    std::array<Pair, boxes_per_block> density;      ///< per bin: area, and area times intensity
    std::array<Pair, boxes_per_block> share;        ///< shares of the first and the second bin
    std::array<float, boxes_per_block> last_share;  ///< share of the last bin
    int min_bin, max_bin;                           ///< the least `first`, the greatest `last`
};

/// The arrays of `count` echoes.
struct BoxArrays {
    const float *range_m, *half_m, *weight, *intensity;
    std::size_t count;
};

/// The boxes of echoes. Echoes wholly outside the range add 0 to the first bin; returns their
/// number. No branches, so that the loop vectorises; inlined, so that `boxes` aliases no echoes.
[[gnu::always_inline]] inline int find_boxes(const BoxArrays& echoes, const RangeBins& bins,
                                             Boxes& boxes) {
    const float per_bin = 1.0F / bins.bin_m;
    const float range_min_m = bins.min_m;
    const auto end = static_cast<float>(bins.count);
    // In bins. An echo without depth needs a width, since its weight is divided by it. It lies
    // behind its range, so that a wall at the border of two bins is in the second alone.
    constexpr float min_depth = 2e-3F;
    const float* const __restrict range_m = echoes.range_m;
    const float* const __restrict half_m = echoes.half_m;
    const float* const __restrict weight = echoes.weight;
    const float* const __restrict intensity = echoes.intensity;
    int outside = 0;
    int min_bin = bins.count;
    int max_bin = 0;
    for (std::size_t k = 0; k < echoes.count; ++k) {
        const float centre = (range_m[k] - range_min_m) * per_bin;
        const float half = half_m[k] * per_bin;
        const float depth = std::max(2.0F * half, min_depth);
        const float low = std::max(centre - half, 0.0F);
        const float high = std::min(centre - half + depth, end);
        const bool inside = low < high;
        outside += inside ? 0 : 1;
        const float from = inside ? low : 0.0F;
        const float to = inside ? high : 0.0F;
        // An echo whose range is NaN is outside as well; its weight must not reach a bin.
        const float density = inside ? weight[k] / depth : 0.0F;
        const float echo = inside ? density * intensity[k] : 0.0F;
        const float first = std::floor(from);
        const float last = std::min(std::floor(to), end - 1.0F);
        // A box that lies within one bin has no tail.
        const float head = std::min(first + 1.0F, to) - from;
        const float tail = first < last ? to - last : 0.0F;
        const float next = last - first > 1.0F ? 1.0F : tail;
        boxes.first[k] = static_cast<int>(first);
        boxes.last[k] = static_cast<int>(last);
        min_bin = std::min(min_bin, boxes.first[k]);
        max_bin = std::max(max_bin, boxes.last[k]);
        boxes.density[k] = {density, echo};
        boxes.share[k] = {head, next};
        boxes.last_share[k] = tail;
    }
    boxes.min_bin = min_bin;
    boxes.max_bin = max_bin;
    return outside;
}

/// Adds the parts of box k that lie in its first two bins: four products and four sums at once, by
/// intrinsics, since compilers turn the plain code into two additions or four single loads.
void add_two(const Boxes& boxes, std::size_t k, BinSum& to) {
    const auto twice = [](const Pair& pair) {
        return _mm_castpd_ps(_mm_loaddup_pd(reinterpret_cast<const double*>(&pair)));
    };
    const __m128 density = twice(boxes.density[k]);
    const __m128 share = _mm_permute_ps(twice(boxes.share[k]), _MM_SHUFFLE(1, 1, 0, 0));
    _mm_store_ps(&to.weight, _mm_add_ps(_mm_load_ps(&to.weight), _mm_mul_ps(density, share)));
}

/// Adds the part of box k that lies beyond its first two bins. `first` is its first bin.
void add_rest(const Boxes& boxes, std::size_t k, BinSum* first) {
    const Pair density = boxes.density[k];
    BinSum* const last = first + (boxes.last[k] - boxes.first[k]);
    for (BinSum* whole = first + 2; whole != last; ++whole) {
        whole->weight += density.first;
        whole->echo += density.second;
    }
    last->weight += density.first * boxes.last_share[k];
    last->echo += density.second * boxes.last_share[k];
}

}  // namespace

void RangeBoxes::resize(std::size_t count) {
    range_m.resize(count);
    half_m.resize(count);
    weight.resize(count);
    intensity.resize(count);
}

void BinSums::clear(int bins) {
    const std::size_t size = static_cast<std::size_t>(bins) + 1;
    if (begins.size() == size)
        std::fill(begins.begin() + first + 1, begins.begin() + end + 1, BinSum{});
    else
        begins.assign(size, BinSum{});
    first = end = 0;
}

void BinSums::include(int from, int to) {
    first = end > first ? std::min(first, from) : from;
    end = std::max(end, to);
}

std::uint64_t accumulate(const RangeBoxes& echoes, const RangeBins& bins, BinSums& sums) {
    return accumulate(echoes, 0, echoes.size(), bins, sums);
}

std::uint64_t accumulate(const RangeBoxes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums) {
    std::uint64_t outside = 0;
    Boxes boxes;
    BinSum* const bin_0 = sums.begins.data() + 1;
    for (std::size_t from = begin; from < end; from += boxes_per_block) {
        const std::size_t count = std::min(boxes_per_block, end - from);
        outside += find_boxes({echoes.range_m.data() + from, echoes.half_m.data() + from,
                               echoes.weight.data() + from, echoes.intensity.data() + from, count},
                              bins, boxes);
        sums.include(boxes.min_bin, boxes.max_bin + 1);
        // Most boxes have one or two bins. A branch between them would be mispredicted.
        for (std::size_t k = 0; k < count; ++k) {
            BinSum* const first = bin_0 + boxes.first[k];
            add_two(boxes, k, *first);
            if (boxes.last[k] - boxes.first[k] > 1) add_rest(boxes, k, first);
        }
    }
    return outside;
}

EchoSums::EchoSums(const RangeBins& bins, int beams)
    : bins_(bins),
      beams_(static_cast<std::size_t>(beams)),
      stride_(static_cast<std::size_t>(bins.count) + 1),
      occupied_(beams_ * stride_),
      unused_(stride_) {}

void EchoSums::add(const EchoBlock& echoes, std::span<const std::uint32_t> sources) {
    Boxes boxes;
    const auto end = static_cast<std::size_t>(echoes.count);
    for (std::size_t from = 0; from < end; from += boxes_per_block) {
        const std::size_t count = std::min(boxes_per_block, end - from);
        find_boxes({echoes.range_m.data() + from, echoes.half_m.data() + from,
                    echoes.weight.data() + from, echoes.intensity.data() + from, count},
                   bins_, boxes);
        for (std::size_t k = 0; k < count; ++k) {
            if (!(boxes.density[k].first > 0.0F)) continue;
            const std::uint32_t source = sources[from + k];
            const std::uint32_t beam = echoes.beam[from + k];
            if (source >= rows_.size()) rows_.resize(source + 1);
            if (rows_[source].empty()) rows_[source].resize(beams_);
            Row& row = rows_[source][beam];
            if (!row) row = std::make_unique<Sum[]>(stride_);
            const int first = boxes.first[k];
            const int rest = boxes.last[k] - first;
            const float echo = boxes.density[k].second;
            Sum& sum = row[first];
            sum.echo += echo * boxes.share[k].first;
            sum.next += echo * boxes.share[k].second;
            std::uint8_t* const occupied =
                echoes.behind_walls ? &unused_[first] : &occupied_[beam * stride_ + first];
            occupied[0] = 1;
            // The first bin again if the box ends in it: a branch would be mispredicted.
            occupied[boxes.share[k].second > 0.0F ? 1 : 0] = 1;
            if (rest < 2) continue;
            for (int i = 2; i < rest; ++i) {
                row[first + i].echo += echo;
                occupied[i] = 1;
            }
            row[first + rest].echo += echo * boxes.last_share[k];
            if (boxes.last_share[k] > 0.0F) occupied[rest] = 1;
        }
    }
}

bool EchoSums::add_to(std::uint32_t source, int beam, std::span<float> total) const {
    if (source >= rows_.size() || rows_[source].empty() || !rows_[source][beam]) return false;
    const Sum* const __restrict row = rows_[source][beam].get();
    float* const __restrict to = total.data();
    to[0] += row[0].echo;
    for (int i = 1; i < bins_.count; ++i)
        to[i] += row[i].echo + row[i - 1].next;
    return true;
}

}  // namespace sonarsim
