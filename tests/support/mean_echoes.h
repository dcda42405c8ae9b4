#pragma once

#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim::test {

/// The image of a view's samples, [beams, range_bins]: the mean over each bin (Eq. 9), with every
/// sample a box in range.
std::vector<double> mean_echoes(const Scene& scene, const View& view, const Samples& samples);

}  // namespace sonarsim::test
