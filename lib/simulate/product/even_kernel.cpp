#include "simulate/product/even_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sonarsim {

namespace {

std::array<double, 3> three_weights(double u) {
    const double s = (2.0 - std::sqrt(1.0 - 3.0 * u * u)) / 3.0;
    return {0.5 * (s - u), 1.0 - s, 0.5 * (s + u)};
}

/// Rounds weights to multiples of 1/256 that still add up to 1, by rounding the cumulative sums.
void round_weights(std::span<const double> exact, float* rounded) {
    double sum = 0.0;
    double before = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        sum += exact[k];
        const double now = std::round(256.0 * sum);
        rounded[k] = static_cast<float>((now - before) / 256.0);
        before = now;
    }
}

}  // namespace

KernelTable make_kernel(double extent, int unit) {
    const double window = std::max(0.0, extent - 1.0);
    const int points = 1 + static_cast<int>(std::ceil(16.0 * window));
    const int bins =
        3 + static_cast<int>(std::ceil(window));  // bins that can have a weight at once
    KernelTable table;
    table.taps = (bins + unit - 1) / unit * unit;
    table.weights.assign(static_cast<std::size_t>(KernelTable::phases) * table.taps, 0.0F);
    for (int phase = 0; phase < KernelTable::phases; ++phase) {
        // The centres of bins are at whole numbers here; the pixel's bin is 0.
        const double centre = (phase + 0.5) / KernelTable::phases - 0.5;
        const int first = static_cast<int>(std::floor(centre - 0.5 * window + 0.5)) - 1;
        std::vector<double> weights(bins);
        for (int k = 0; k < points; ++k) {
            const double at = centre + window * ((k + 0.5) / points - 0.5);
            const double nearest = std::floor(at + 0.5);
            const std::array<double, 3> three = three_weights(at - nearest);
            for (int t = 0; t < 3; ++t)
                weights[static_cast<int>(nearest) - 1 - first + t] += three[t] / points;
        }
        table.first[phase] = first;
        round_weights(weights, table.weights.data() + static_cast<std::size_t>(phase) * table.taps);
    }
    return table;
}

KernelPlace kernel_place(double coordinate) {
    const double bin = std::floor(coordinate);
    const int phase = static_cast<int>((coordinate - bin) * KernelTable::phases);
    return {static_cast<int>(bin), std::min(phase, KernelTable::phases - 1)};
}

}  // namespace sonarsim
