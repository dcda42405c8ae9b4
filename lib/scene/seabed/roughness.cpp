#include "scene/seabed/roughness.h"

#include <cmath>

#include "core/elementary.h"
#include "core/log_gamma.h"
#include "core/units.h"
#include "scene/seabed/smooth_field.h"

namespace sonarsim {

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
    constexpr double least_t = 0.2;
    constexpr double step = 4.0;
    // Fields with a larger t k0^2 are left out: their factor exp(-t k0^2) is below e^-10.
    constexpr double most = 10.0;
    const double corner = 2.0 * pi / roughness.corner_m;
    const double a = 0.5 * roughness.exponent;
    const double factor = roughness.strength * pi * logarithm(step) * exponential(-log_gamma(a));
    double t = least_t * grid.cell_m * grid.cell_m;
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
