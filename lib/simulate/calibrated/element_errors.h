#pragma once

#include <complex>
#include <vector>

#include "input/mission/instrument.h"
#include "simulate/calibrated/line_array.h"

namespace sonarsim {

/// The errors e_n of the elements of the array that forms beams, (1 + e_n) being the factors on
/// their weights: gains of normally distributed decibels and normally distributed phases, drawn by
/// the serial number.
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

}  // namespace sonarsim
