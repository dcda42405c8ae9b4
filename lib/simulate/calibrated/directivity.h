#pragma once

#include "input/mission/instrument.h"
#include "simulate/calibrated/line_array.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

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
/// receiver are assumed to be equally wide in elevation, so each is sqrt(2) times as wide as both
/// together (exact for Gaussian beams).
double receiving_directivity(const BeamConfig& beam);

/// The transmitter: a fan transmits evenly into its azimuth, others transmit with the receiving
/// beam.
double transmitting_directivity(const BeamConfig& beam, const View& view);

}  // namespace sonarsim
