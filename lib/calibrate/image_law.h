#pragma once

#include "calibrate/fitted_image.h"

namespace sonarsim {

/// The number of patches that a fit to noise needs.
inline constexpr std::size_t least_noise_patches = 24;

/// The patches that determine pulse and array: noise, or echoes if there is too little noise.
const std::vector<std::size_t>& chosen_patches(const PatchClasses& classes, const ImageFit& fit);

/// Fits offset, law and looks, and finds the noise.
void fit_law_of_image(const Recording& recording, const StartInstrument& start, ImageFit& fit);

/// Removes the texture's effect from the law, and sets offset, bits and law.
void set_law_of_image(const Recording& recording, const StartInstrument& start, ImageFit& fit);

}  // namespace sonarsim
