#include "calibrated/near_field.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// From one entry to the next the phase at the ends of the array, of which the square of the pattern
// has twice as much, changes by this.
constexpr double phase_by_entry = 0.3;

/// The phase at the ends of the array at curvature 1, rad.
double end_phase(const LineArray& array, double wavelength_m) {
    return 0.25 * pi * array.wavelengths * array.wavelengths * wavelength_m;
}

}  // namespace

std::complex<double> unfocused_pattern(const LineArray& array, double u, double wavelength_m,
                                       double curvature_per_m) {
    const double bend = 4.0 * end_phase(array, wavelength_m) * curvature_per_m;
    const double turn = 2.0 * pi * array.wavelengths * u;
    // Steps that turn by less than a quarter of a radian.
    const int steps = 32 + static_cast<int>(4.0 * (std::fabs(bend) + std::fabs(turn)));
    std::complex<double> sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double x = (k + 0.5) / steps - 0.5;
        const SinCos phase = sincos(x * (turn - bend * x));
        sum += array.weight(x) * std::complex<double>(phase.cos, -phase.sin);
    }
    return sum / static_cast<double>(steps);
}

UnfocusedBeam unfocused_beam(const LineArray& array, double wavelength_m, double range_min_m,
                             double greatest_sine) {
    const double nearest = std::max(range_min_m, array.wavelengths * wavelength_m);
    const double turn = 2.0 * pi * array.wavelengths * greatest_sine;
    UnfocusedBeam out;
    out.greatest_sine = static_cast<float>(greatest_sine);
    out.most_curvature = static_cast<float>(1.0 / nearest);
    const auto entries = [](double phase) { return 2 + static_cast<int>(phase / phase_by_entry); };
    out.sines = 1 + entries(turn);
    out.curvatures = 1 + entries(end_phase(array, wavelength_m) / nearest);
    out.sines_per_unit = static_cast<float>((out.sines - 1) / (2.0 * greatest_sine));
    out.curvatures_per_unit = static_cast<float>((out.curvatures - 1) * nearest);
    for (int j = 0; j < out.curvatures; ++j) {
        for (int i = 0; i < out.sines; ++i) {
            const double u = greatest_sine * (2.0 * i / (out.sines - 1) - 1.0);
            const std::complex<double> one_way =
                unfocused_pattern(array, u, wavelength_m, j / (nearest * (out.curvatures - 1)));
            out.values.emplace_back(one_way * one_way);
        }
    }
    return out;
}

}  // namespace sonarsim
