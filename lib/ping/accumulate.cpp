#include "ping/accumulate.h"

#include <algorithm>
#include <array>

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
    // In bins: an echo without depth still needs a width to be divided by.
    constexpr float least_half = 1e-3F;
    std::uint64_t outside = 0;
    // The boxes of a block are computed in vectors; the sums have to be added one by one.
    constexpr std::size_t block = 64;
    std::array<float, block> low, high, density;
    for (std::size_t from = begin; from < end; from += block) {
        const std::size_t boxes = std::min(block, end - from);
        for (std::size_t k = 0; k < boxes; ++k) {
            const float centre = (echoes.range_m[from + k] - bins.min_m) * per_bin;
            const float half = std::max(echoes.half_m[from + k] * per_bin, least_half);
            low[k] = std::max(centre - half, 0.0F);
            high[k] = std::min(centre + half, count);
            density[k] = echoes.weight[from + k] / (2.0F * half);
        }
        for (std::size_t k = 0; k < boxes; ++k) {
            if (!(low[k] < high[k])) {
                ++outside;
                continue;
            }
            const float echo = density[k] * echoes.intensity[from + k];
            const int first = static_cast<int>(low[k]);
            const int last = std::min(static_cast<int>(high[k]), bins.count - 1);
            // A box within one bin is all head. No branch: it would be mispredicted half the time.
            const float head = std::min(static_cast<float>(first + 1), high[k]) - low[k];
            const float tail = first < last ? high[k] - static_cast<float>(last) : 0.0F;
            sums.weight[first] += density[k] * head;
            sums.echo[first] += echo * head;
            sums.weight[last] += density[k] * tail;
            sums.echo[last] += echo * tail;
            for (int i = first + 1; i < last; ++i) {
                sums.weight[i] += density[k];
                sums.echo[i] += echo;
            }
        }
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

std::vector<float> image_of_beams(std::span<const float> by_beam, int range_bins, int beams) {
    std::vector<float> image(by_beam.size());
    constexpr int tile = 16;  // stays in the cache
    for (int i0 = 0; i0 < range_bins; i0 += tile) {
        const int i1 = std::min(i0 + tile, range_bins);
        for (int j0 = 0; j0 < beams; j0 += tile) {
            const int j1 = std::min(j0 + tile, beams);
            for (int i = i0; i < i1; ++i) {
                for (int j = j0; j < j1; ++j) {
                    image[static_cast<std::size_t>(i) * beams + j] =
                        by_beam[static_cast<std::size_t>(j) * range_bins + i];
                }
            }
        }
    }
    return image;
}

}  // namespace sonarsim
