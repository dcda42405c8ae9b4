#include "input/scene/seabed/sediments.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"
#include "input/scene/seabed/relief.h"

namespace sonarsim {

namespace {

/// The quantile of the normal(0, 1) distribution, within 4.5e-4 (Abramowitz and Stegun 26.2.23).
double normal_quantile(double probability) {
    const double tail = std::max(std::min(probability, 1.0 - probability), 1e-300);
    const double t = std::sqrt(-2.0 * logarithm(tail));
    const double quantile = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                                    (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    return std::copysign(quantile, probability - 0.5);
}

/// The `length_m` of a smooth_field() that crosses its mean upwards once in `patch_m`, on average
/// along a line. Rice: a process of unit variance crosses 0 upwards sqrt(-C''(0)) / (2 pi) times
/// per metre, and here C''(0) = -1 / (2 length^2).
double length_of_patches(double patch_m) {
    return patch_m / (2.0 * pi * std::sqrt(2.0));
}

}  // namespace

BedSediments sediments_of(const BedGrid& grid, const std::vector<BedSedimentConfig>& list,
                          double patch_m, std::uint64_t seed) {
    BedSediments out{std::vector<std::uint8_t>(grid.size(), 0), {}, {}, 0.0F};
    if (list.size() < 2) return out;
    constexpr double fall = 0.5946035575013605;  // 0.5^0.75
    out.values.resize(grid.size(), 0.0F);
    double amplitude = 1.0;
    double variance = 0.0;
    std::uint32_t octave = 0;
    for (double wave_m = longest_wave * patch_m; octave == 0 || wave_m >= 4.0 * grid.cell_m;
         wave_m *= 0.5) {
        const std::vector<float> waves = smooth_field(grid, length_of_patches(wave_m),
                                                      bed_key(seed, BedDraw::sediments, octave++));
        for (std::size_t i = 0; i < waves.size(); ++i)
            out.values[i] += static_cast<float>(amplitude) * waves[i];
        variance += amplitude * amplitude;
        if (wave_m <= patch_m) amplitude *= fall;
    }
    // The slope of waves with one variance and the lengths patch_m, 2 patch_m, ... is 2 pi /
    // patch_m times the root of 1 + 1/4 + ..., 7 / patch_m, so that a border is 0.1 to 0.6 patch_m
    // wide.
    const PhiloxKey key = bed_key(seed, BedDraw::sediments, 255);
    out.mixed = 0.3F + 1.9F * unit_float(philox({0, 0, 0, 0}, key).x0);
    double sum = 0.0;
    for (const BedSedimentConfig& sediment : list)
        sum += sediment.share;
    double below = 0.0;
    for (const BedSedimentConfig& sediment : list) {
        below += sediment.share;
        out.limits.push_back(
            static_cast<float>(std::sqrt(variance) * normal_quantile(below / sum)));
    }
    out.limits.pop_back();
    for (std::size_t i = 0; i < out.cells.size(); ++i) {
        for (const float limit : out.limits)
            out.cells[i] =
                static_cast<std::uint8_t>(out.cells[i] + (out.values[i] > limit ? 1 : 0));
    }
    return out;
}

}  // namespace sonarsim
