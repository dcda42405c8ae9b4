#pragma once

#include <complex>

namespace sonarsim {

/// A line array: an aperture of length L, weighted along x = position / L in [-1/2, 1/2] by
///
///     w(x) = p + (1 - p) cos^2(pi x),
///
/// a cosine on a pedestal: p = 1 is uniform (side lobes at -13.3 dB), p = 0.08 is Hamming's (-42
/// dB).
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

/// The array whose highest side lobe is `side_lobe_db` (-42 to -13.3) below its axis and whose
/// power is halved at half of `width_rad` off it.
LineArray line_array(double width_rad, double side_lobe_db);

}  // namespace sonarsim
