#include "ping/accumulate.h"

#include <algorithm>

namespace sonarsim {

void BinSums::clear(int bins) {
    weight.assign(bins, 0.0F);
    echo.assign(bins, 0.0F);
}

std::uint64_t accumulate(const Echoes& echoes, const RangeBins& bins, BinSums& sums) {
    return accumulate(echoes, 0, echoes.size(), bins, sums);
}

std::uint64_t accumulate(const Echoes& echoes, std::size_t begin, std::size_t end,
                         const RangeBins& bins, BinSums& sums) {
    const float per_bin = 1.0F / bins.bin_m;
    const auto count = static_cast<float>(bins.count);
    // An echo without depth still needs a width to be divided by.
    constexpr float thinnest = 1e-3F;
    std::uint64_t outside = 0;
    for (std::size_t k = begin; k < end; ++k) {
        const float centre = (echoes.range_m[k] - bins.min_m) * per_bin;
        const float half = std::max(echoes.half_m[k] * per_bin, thinnest);
        const float low = std::max(centre - half, 0.0F);
        const float high = std::min(centre + half, count);
        if (!(low < high)) {
            ++outside;
            continue;
        }
        const float density = echoes.weight[k] / (2.0F * half);
        const float echo = density * echoes.intensity[k];
        const int first = static_cast<int>(low);
        const int last = std::min(static_cast<int>(high), bins.count - 1);
        if (first == last) {
            sums.weight[first] += density * (high - low);
            sums.echo[first] += echo * (high - low);
            continue;
        }
        const float head = static_cast<float>(first + 1) - low;
        sums.weight[first] += density * head;
        sums.echo[first] += echo * head;
        for (int i = first + 1; i < last; ++i) {
            sums.weight[i] += density;
            sums.echo[i] += echo;
        }
        const float tail = high - static_cast<float>(last);
        sums.weight[last] += density * tail;
        sums.echo[last] += echo * tail;
    }
    return outside;
}

std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity) {
    std::uint64_t occupied = 0;
    for (std::size_t i = 0; i < intensity.size(); ++i) {
        const bool seen = sums.weight[i] > 0.0F;
        intensity[i] = seen ? sums.echo[i] / sums.weight[i] : 0.0F;
        occupied += seen;
    }
    return occupied;
}

}  // namespace sonarsim
