#include "visibility/octree/leaf_size.h"

#include <algorithm>

namespace sonarsim {

namespace {

/// Edge of an automatic leaf, in widths of a beam.
constexpr double beams_per_leaf = 1.4;
/// And at least in range bins: nearer than that, beams tell apart more than bins can show.
constexpr double least_bins_per_leaf = 0.5;
/// In range bins, where beams are as wide as the view.
constexpr double bins_per_leaf = 1.5;
/// However wide the bins are.
constexpr double leaves_per_range = 64.0;

}  // namespace

LeafSize::LeafSize(const View& view, double fixed_m)
    : fixed_m_(static_cast<float>(fixed_m)),
      per_m_(0.0F),
      least_m_(static_cast<float>(bins_per_leaf * view.bin_m())) {
    if (view.shape == ViewShape::fan) {
        per_m_ = static_cast<float>(beams_per_leaf * view.azimuth_rad / view.beams);
        least_m_ = static_cast<float>(least_bins_per_leaf * view.bin_m());
    }
    least_m_ = std::min(least_m_, static_cast<float>(view.range_max_m / leaves_per_range));
}

float LeafSize::at(float distance_m) const {
    return fixed_m_ > 0.0F ? fixed_m_ : std::max(per_m_ * distance_m, least_m_);
}

}  // namespace sonarsim
