#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/elementary.h"
#include "core/random.h"

namespace sonarsim {

// The bootstrap repeats an estimate with random weights of the units of the sample.

/// The number of times that each of `count` units is drawn when `count` are drawn with replacement.
inline std::vector<double> drawn_counts(int count, PhiloxKey key) {
    std::vector<double> weights(static_cast<std::size_t>(count), 0.0);
    for (int k = 0; k < count; ++k) {
        const PhiloxBlock block = philox({static_cast<std::uint32_t>(k), 0, 0, 0}, key);
        const double at = unit_double(block.x0, block.x1) * count;
        weights[static_cast<std::size_t>(at)] += 1.0;
    }
    return weights;
}

/// A weight of mean 1, exponentially distributed, of the Bayesian bootstrap (Rubin 1981).
inline double drawn_weight(PhiloxBlock unit, PhiloxKey key) {
    return -natural_log(unit_float(philox(unit, key).x0));
}

/// The variances of the numbers that `estimate` returns for the draws 0, 1, ... Numbers that are
/// not finite are left out. `near` are values near these numbers, to limit cancellation.
template <class Estimate>
std::vector<double> drawn_variances(const std::vector<double>& near, int draws,
                                    const Estimate& estimate) {
    std::vector<double> sums(near.size()), squares(near.size()), counts(near.size());
    for (int draw = 0; draw < draws; ++draw) {
        const std::vector<double> drawn = estimate(static_cast<std::uint32_t>(draw));
        for (std::size_t k = 0; k < near.size(); ++k) {
            const double off = drawn[k] - near[k];
            if (!std::isfinite(off)) continue;
            sums[k] += off;
            squares[k] += off * off;
            counts[k] += 1.0;
        }
    }
    for (std::size_t k = 0; k < near.size(); ++k) {
        const double mean = counts[k] > 0.0 ? sums[k] / counts[k] : 0.0;
        const double square = counts[k] > 1.0 ? squares[k] / counts[k] : 0.0;
        squares[k] = std::max(square - mean * mean, 0.0);
    }
    return squares;
}

}  // namespace sonarsim
