#pragma once

#include "input/mission/instrument.h"
#include "simulate/calibrated/signal/line_array.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The errors e_n of the elements of the array that forms beams, (1 + e_n) being the factors on
/// their weights: normally distributed decibels and phases, drawn by the serial number.
///
/// Small errors have the variance s^2 = (ln(10) / 20 gain_error_db)^2 + phase_error_rad^2. With
/// weights w_n the pattern is sum w_n (1 + e_n) exp(i k x_n u). The errors are independent, so the
/// mean of its power is that of the array without errors plus s^2 sum w_n^2. Relative to the main
/// lobe, (sum w_n)^2, that is s^2 / N_eff with N_eff = (sum w_n)^2 / sum w_n^2 (e.g. Mailloux,
/// Phased Array Antenna Handbook, chapter 7).
std::vector<std::complex<double>> element_errors(const ElementsConfig& elements, int count);

/// The number of an array's elements, half a wavelength apart.
double element_count(const LineArray& array);

/// s^2 / N_eff of an array.
double mean_side_lobe(const LineArray& array, const ElementsConfig& elements);

/// The pattern of an array with the errors of its elements. `array` has no errors of phase.
class PatternWithErrors {
  public:
    PatternWithErrors(const LineArray& array, const ElementsConfig& elements);

    /// The amplitude at the sine u.
    std::complex<double> operator()(double u) const;

  private:
    LineArray array_;
    std::vector<std::complex<double>> errors_;  ///< times the weights; empty: none
};

// The directivity of a pattern of power p, 1 on its axis: 4 pi / integral of p over all directions.
// In isotropic noise it is the gain of a beam in the ratio of echo to noise.

/// Mean of the squared weights of an array over the square of their mean: 1 if they are uniform. An
/// array with a taper has more noise than a uniform one by this factor.
double taper_loss(const LineArray& array);

/// A line: 2 L / lambda for uniform weights.
double line_directivity(const LineArray& array);

/// A rectangle with these sides: 4 pi L W / lambda^2 for uniform weights.
double rectangle_directivity(const LineArray& along, const LineArray& across);

/// A disc whose power is halved at half of `width_rad`: (pi D / lambda)^2.
double piston_directivity(double width_rad);

/// The receiving beam. The sides of a rectangle follow from the half-power widths. Transmitter and
/// receiver are taken as equally wide in elevation: each sqrt(2) times as wide as both together.
double receiving_directivity(const BeamConfig& beam);

/// A fan transmits evenly into its azimuth, others transmit with the receiving beam.
double transmitting_directivity(const BeamConfig& beam, const View& view);

/// The amplitude off the axis of a disc that moves as a whole, 2 J1(x) / x; x is
/// 2 pi (radius / wavelength) times the sine of the angle. 1 on the axis, half of the power at
/// x = 1.6163, the first null at 3.8317, the first side lobe at -17.6 dB.
double piston_pattern(double x);

/// x by the sine of the angle, for a disc whose power is halved at half of `width_rad`.
double piston_scale(double width_rad);

}  // namespace sonarsim
