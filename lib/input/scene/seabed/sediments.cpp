#include "input/scene/seabed/sediments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/units.h"
#include "input/scene/seabed/smooth_field.h"

namespace sonarsim {

namespace {

inline double normal_density(double x) {
    return exponential(-0.5 * x * x) / std::sqrt(2.0 * pi);
}

/// The probability of a normal number above x >= 0, within 1e-7 (Abramowitz and Stegun 26.2.17).
inline double normal_tail(double x) {
    const double t = 1.0 / (1.0 + 0.2316419 * x);
    const double series =
        t * (0.319381530 +
             t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
    return normal_density(x) * series;
}

/// The quantile of the normal(0, 1) distribution, within 1e-6; infinite for 0 and 1.
double normal_quantile(double probability) {
    const double tail = std::min(probability, 1.0 - probability);
    if (tail <= 0.0)
        return std::copysign(std::numeric_limits<double>::infinity(), probability - 0.5);
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (normal_tail(middle) > tail ? low : high) = middle;
    }
    return std::copysign(low, probability - 0.5);
}

/// The `length_m` of a smooth_field() that crosses its mean upwards once in `patch_m`, on average
/// along a line. Rice: a process of unit variance crosses 0 upwards sqrt(-C''(0)) / (2 pi) times
/// per metre, and here C''(0) = -1 / (2 length^2).
double length_of_patches(double patch_m) {
    return patch_m / (2.0 * pi * std::sqrt(2.0));
}

}  // namespace

std::vector<std::uint8_t> sediments_of(const BedGrid& grid, const std::vector<BedSediment>& list,
                                       double patch_m, std::uint64_t seed) {
    std::vector<std::uint8_t> out(grid.size(), 0);
    if (list.size() < 2) return out;
    const std::vector<float> large =
        smooth_field(grid, length_of_patches(patch_m), bed_key(seed, BedDraw::sediments));
    const std::vector<float> small = smooth_field(grid, length_of_patches(bays_per_patch * patch_m),
                                                  bed_key(seed, BedDraw::borders));
    double sum = 0.0;
    for (const BedSediment& sediment : list)
        sum += sediment.share;
    std::vector<double> limits;
    double below = 0.0;
    for (const BedSediment& sediment : list) {
        below += sediment.share;
        limits.push_back(normal_quantile(below / sum));
    }
    limits.pop_back();
    constexpr double part_of_borders = 0.25;
    const double part_of_patches = std::sqrt(1.0 - part_of_borders * part_of_borders);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double value = part_of_patches * static_cast<double>(large[i]) +
                             part_of_borders * static_cast<double>(small[i]);
        for (const double limit : limits)
            out[i] = static_cast<std::uint8_t>(out[i] + (value > limit ? 1 : 0));
    }
    return out;
}

}  // namespace sonarsim
