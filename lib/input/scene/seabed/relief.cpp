#include "input/scene/seabed/relief.h"

#include <cmath>

#include "core/elementary.h"
#include "core/log_gamma.h"
#include "core/units.h"
#include "input/scene/seabed/smooth_field.h"

namespace sonarsim {

namespace {

/// Real or imaginary part of the field that moves the crests. Its wave vectors have the standard
/// deviation `ripple_spread` times the ripples' wave number.
std::vector<float> crest_field(const BedGrid& grid, const BedRipples& ripples, std::uint32_t part,
                               std::uint64_t seed) {
    // exp(-(length k)^2) has the deviation 1 / (sqrt(2) length).
    const double deviation = ripple_spread * 2.0 * pi / ripples.length_m;
    return smooth_field(grid, 1.0 / (std::sqrt(2.0) * deviation),
                        bed_key(seed, BedDraw::ripples, part));
}

}  // namespace

void add_ripples(const BedGrid& grid, const BedRipples& ripples, std::uint64_t seed,
                 std::vector<double>& heights) {
    if (ripples.height_m == 0.0) return;
    const std::vector<float> real = crest_field(grid, ripples, 0, seed);
    const std::vector<float> imaginary = crest_field(grid, ripples, 1, seed);
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
                (re * wave.cos - im * wave.sin) / std::sqrt(re * re + im * im + rounding);
            heights[i] += 0.5 * ripples.height_m * height;
        }
    }
}

double roughness_strength(double spectral_strength_cm4, double exponent) {
    constexpr double m_per_cm = 0.01;
    // W m^-4 = w cm^4 (k cm)^-exponent, with cm = 0.01 m.
    return spectral_strength_cm4 * power(m_per_cm, 4.0 - exponent);
}

void add_roughness(const BedGrid& grid, const BedRoughness& roughness, std::uint64_t seed,
                   std::vector<double>& heights) {
    if (roughness.strength == 0.0) return;
    // The square of the shortest length of a field, in cells. Shorter fields would be aliased by
    // the grid; longer ones leave out more of the spectrum at short wavelengths.
    constexpr double min_t = 0.2;
    constexpr double step = 4.0;
    // Fields with a larger t k0^2 are left out: their factor exp(-t k0^2) is below e^-10.
    constexpr double most = 10.0;
    const double corner = 2.0 * pi / roughness.corner_m;
    const double a = 0.5 * roughness.exponent;
    const double factor = roughness.strength * pi * logarithm(step) * exponential(-log_gamma(a));
    double t = min_t * grid.cell_m * grid.cell_m;
    for (std::uint32_t octave = 0; t * corner * corner < most; ++octave, t *= step) {
        const double variance = factor * power(t, a - 1.0) * exponential(-t * corner * corner);
        const double deviation = std::sqrt(variance);
        const std::vector<float> field =
            smooth_field(grid, std::sqrt(t), bed_key(seed, BedDraw::roughness, octave));
        for (std::size_t i = 0; i < heights.size(); ++i)
            heights[i] += deviation * static_cast<double>(field[i]);
    }
}

}  // namespace sonarsim
