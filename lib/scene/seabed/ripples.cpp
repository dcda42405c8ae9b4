#include "scene/seabed/ripples.h"

#include <cmath>

#include "core/elementary.h"
#include "core/units.h"
#include "scene/seabed/patches.h"
#include "scene/seabed/smooth_field.h"

namespace sonarsim {

namespace {

/// Real or imaginary part of the field that moves the crests. Its wave vectors have the standard
/// deviation `spread` times the ripples' wave number; without spread the crests are straight.
std::vector<float> crest_field(const BedGrid& grid, const BedRipples& ripples, std::uint32_t part,
                               std::uint64_t seed) {
    if (ripples.spread <= 0.0) return std::vector<float>(grid.size(), part == 0 ? 1.0F : 0.0F);
    // exp(-(length k)^2) has the deviation 1 / (sqrt(2) length).
    const double deviation = ripples.spread * 2.0 * pi / ripples.length_m;
    return smooth_field(grid, 1.0 / (std::sqrt(2.0) * deviation),
                        bed_key(seed, BedDraw::ripples, part));
}

}  // namespace

void add_ripples(const BedGrid& grid, const BedRipples& ripples, std::uint64_t seed,
                 std::vector<double>& heights) {
    if (ripples.height_m == 0.0 || ripples.share == 0.0) return;
    const std::vector<float> real = crest_field(grid, ripples, 0, seed);
    const std::vector<float> imaginary = crest_field(grid, ripples, 1, seed);
    const std::vector<float> here =
        patches(grid, ripples.share, ripples.patch_m, bed_key(seed, BedDraw::ripple_patches));
    const SinCos direction = sincos(ripples.direction_rad);
    // Added to |b|^2, whose mean is 2, so that a crest ends and its height falls to 0 where b is 0.
    constexpr double rounding = 0.05;
    std::size_t i = 0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column, ++i) {
            const double turns =
                (direction.cos * grid.x_m(column) + direction.sin * grid.y_m(row)) /
                ripples.length_m;
            const SinCos wave = sincos(2.0 * pi * (turns - std::floor(turns)));
            const auto re = static_cast<double>(real[i]);
            const auto im = static_cast<double>(imaginary[i]);
            const double height =
                (re * wave.cos - im * wave.sin) /
                std::sqrt(re * re + im * im + (ripples.spread > 0 ? rounding : 0));
            heights[i] += 0.5 * ripples.height_m * static_cast<double>(here[i]) * height;
        }
    }
}

}  // namespace sonarsim
