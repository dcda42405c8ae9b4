#pragma once

#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/slices/scan.h"

namespace sonarsim {

/// The range bins that a sample covers, in bins from the least range.
Interval bins_of(const View& view, const Sample& sample);

/// Surface of a view by bin, [beams, range_bins]: area, and area times intensity.
struct SampledImage {
    std::vector<float> area;
    std::vector<float> echo;

    float intensity(std::size_t k) const { return area[k] > 0.0F ? echo[k] / area[k] : 0.0F; }
};

/// The image of samples without noise, cut as in the paper's model.
SampledImage image_of(const Scene& scene, const View& view, const Samples& samples);

}  // namespace sonarsim
