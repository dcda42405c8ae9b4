#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The image of a view's samples, [beams, range_bins]: the mean over each bin (Eq. 9), with every
/// sample a box in range.
std::vector<double> mean_echoes(const Scene& scene, const View& view, const Samples& samples);

/// The relative L1 of two images of the same shape: sum |A - B| / sum B, where B is `fine`.
double image_change(std::span<const double> coarse, std::span<const double> fine);

}  // namespace sonarsim
