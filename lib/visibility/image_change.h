#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The image of a view's samples, [beams, range_bins], as in Eq. 9 of the model: the mean over each
/// bin, every sample a box in range.
std::vector<double> mean_echoes(const Scene& scene, const View& view, const Samples& samples);

/// By how much one image differs from another of the same shape: sum |A - B| / sum B, B of `fine`.
double image_change(std::span<const double> coarse, std::span<const double> fine);

}  // namespace sonarsim
