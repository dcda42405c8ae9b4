#pragma once

#include "simulate/calibrated/equation/bottom.h"

namespace sonarsim {

/// Backscattering from the surface of the water below wind of `wind_m_s`: sigma per area and solid
/// angle, whose 10 log is the strength S. `grazing_rad`: 0 to pi / 2.
///
/// From 10 kHz on the model of the Applied Physics Laboratory, University of Washington (APL-UW TR
/// 9407, 1994, section II): facets near normal incidence, small waves elsewhere, both weakened by
/// the bubbles below them, and the echo of these bubbles. It was made for 10 to 100 kHz and is an
/// extrapolation above. Below 10 kHz it is the fit of R. P. Chapman and J. H. Harris, J. Acoust.
/// Soc. Am. 34 (1962) 1592, which was measured from 0.4 to 6.4 kHz below 40 degrees, with the same
/// facets.
double wind_surface_section(double grazing_rad, double wind_m_s, double frequency_hz);

/// The same as a material.
Backscatter wind_surface(double wind_m_s, double frequency_hz);

}  // namespace sonarsim
