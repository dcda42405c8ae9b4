#pragma once

#include "calibrate/fitted_image.h"

namespace sonarsim {

/// Fits law, noise, pulse and array, in this order, and the texture of the bottom. InputError for
/// pings that are not from a sonar.
ImageFit fit_image(const Recording& recording, const StartInstrument& start);

}  // namespace sonarsim
