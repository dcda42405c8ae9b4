#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <vector>

namespace sonarsim {

/// A line array: an aperture of length L, weighted along x = position / L in [-1/2, 1/2] by
///
///     w(x) = p + (1 - p) cos^2(pi x),
///
/// a cosine on a pedestal: p = 1 is uniform (side lobes at -13.3 dB), 0.08 Hamming's (-42 dB).
struct LineArray {
    double wavelengths = 1.0;  ///< L / lambda
    double pedestal = 1.0;     ///< p
    /// Error of phase at the ends of the aperture, rad: its quadratic, cubic and quartic part.
    double quadratic_rad = 0.0;
    double cubic_rad = 0.0;
    double quartic_rad = 0.0;

    /// The weight of the aperture at x, 0 outside; its integral without errors of phase is 1.
    std::complex<double> weight(double x) const;
};

/// The amplitude of the array without errors of phase, relative to the axis, at the sine u of the
/// angle off the axis. It is the Fourier transform of the weight; with t = u L / lambda
///
///     (p sinc(t) + (1 - p) / 2 (sinc(t) + (sinc(t + 1) + sinc(t - 1)) / 2)) / ((1 + p) / 2).
double line_pattern(const LineArray& array, double u);

/// The array with the highest side lobe `side_lobe_db` (-42 to -13.3) and the -3 dB width.
LineArray line_array(double width_rad, double side_lobe_db);

/// The amplitude of an unfocused line array at the sine u of the angle off its axis and range r:
///
///     integral of w(x) exp(-2 pi i (x u L / lambda - x^2 L^2 / (2 r lambda))) dx
///
/// with x = position / L (Fresnel's approximation). Far beyond L^2 / lambda it is line_pattern();
/// at shorter range the beam is as wide as the array. `curvature` is 1 / r.
std::complex<double> unfocused_pattern(const LineArray& array, double u, double wavelength_m,
                                       double curvature_per_m);

/// A table of the square of unfocused_pattern(), the two-way pattern.
struct UnfocusedBeam {
    /// The value at the sine u of the angle off the axis and at a range; at ranges below the
    /// array's length it is that at its length. `u` must lie within the table.
    std::complex<float> at(float u, float range_m) const;

    float greatest_sine = 1.0F;  ///< at the ends of the table
    float max_curvature = 0.0F;
    float sines_per_unit = 0.0F, curvatures_per_unit = 0.0F;
    int sines = 0, curvatures = 0;            ///< numbers of entries, both ends included
    std::vector<std::complex<float>> values;  ///< [curvatures, sines]
};

/// The table from `range_min_m` on, for sines up to `greatest_sine`.
UnfocusedBeam unfocused_beam(const LineArray& array, double wavelength_m, double range_min_m,
                             double greatest_sine);

inline std::complex<float> UnfocusedBeam::at(float u, float range_m) const {
    const float across = (u + greatest_sine) * sines_per_unit;
    const float up = std::min(1.0F / range_m, max_curvature) * curvatures_per_unit;
    const int i = std::min(static_cast<int>(std::max(across, 0.0F)), sines - 2);
    const int j = std::min(static_cast<int>(up), curvatures - 2);
    const float s = across - static_cast<float>(i);
    const float t = up - static_cast<float>(j);
    const std::complex<float>* const here =
        values.data() + static_cast<std::ptrdiff_t>(j) * sines + i;
    const std::complex<float> low = here[0] + s * (here[1] - here[0]);
    const std::complex<float> high = here[sines] + s * (here[sines + 1] - here[sines]);
    return low + t * (high - low);
}

}  // namespace sonarsim
