#include "visibility/octree/leaf_size.h"

#include <algorithm>

namespace sonarsim {

namespace {

// Leaf edges at a scale of 1, fitted at an error goal of 3 %.

/// Edge of a leaf in a fan, in beamwidths.
constexpr double beams_per_leaf = 1.4;
/// Least edge in range bins: at short range, beams resolve more than bins can show.
constexpr double least_bins_per_leaf = 0.5;
/// Edge in range bins for views of one beam.
constexpr double bins_per_leaf = 1.5;

// Even if bins are coarse, the shapes of the surface and of its occluders must be right. Without
// these limits, views of few beams or few bins were off by 20 to 150 %.

/// Largest angle that a leaf may span, since its projection is of first order in that angle.
constexpr double widest_rad = 0.03;
/// The same in openings of the view: larger leaves leave gaps between the patches of a surface, and
/// a narrow view may fall into a gap.
constexpr double openings_per_leaf = 1.0;
constexpr double leaves_per_range = 64.0;

/// Limits the work next to the sonar, where angles would require ever smaller leaves.
constexpr double most_leaves_per_range = 1024.0;

/// The error grows linearly with the leaf on all measured scenes (model.md). At this scale the mean
/// over eight poses is 0.2 to 0.8 of the goal; at 1 it reaches the goal on a wreck.
constexpr double scale_per_goal = 0.8 / 0.03;

/// Estimated error before any ping, as a share of the goal.
constexpr double usual_share = 0.75;

}  // namespace

LeafSize::LeafSize(const View& view, double fixed_m)
    : fixed_m_(static_cast<float>(fixed_m)),
      by_bins_m_(static_cast<float>(bins_per_leaf * view.bin_m())),
      by_beams_rad_(0.0F),
      widest_rad_(static_cast<float>(std::min(widest_rad, openings_per_leaf * view.elevation_rad))),
      largest_m_(static_cast<float>(view.range_max_m / leaves_per_range)),
      smallest_m_(static_cast<float>(view.range_max_m / most_leaves_per_range)) {
    if (view.shape == ViewShape::fan) {
        by_beams_rad_ = static_cast<float>(beams_per_leaf * view.azimuth_rad / view.beams);
        by_bins_m_ = static_cast<float>(least_bins_per_leaf * view.bin_m());
    }
    const auto scale = static_cast<float>(scale_per_goal * view.relative_l1);
    const float shape_scale = std::min(scale, 1.0F);
    by_bins_m_ *= scale;
    by_beams_rad_ *= scale;
    widest_rad_ *= shape_scale;
    largest_m_ *= shape_scale;
    smallest_m_ *= shape_scale;
}

float LeafSize::at(float distance_m) const {
    if (fixed_m_ > 0.0F) return fixed_m_;
    const float by_resolution = std::max(by_beams_rad_ * distance_m, by_bins_m_);
    const float by_shape = std::min(widest_rad_ * distance_m, largest_m_);
    return std::max(std::min(by_resolution, by_shape), smallest_m_);
}

LeafSize LeafSize::twice() const {
    LeafSize out = *this;
    for (float* const x : {&out.fixed_m_, &out.by_bins_m_, &out.by_beams_rad_, &out.widest_rad_,
                           &out.largest_m_, &out.smallest_m_})
        *x *= 2.0F;
    return out;
}

double estimated_octree_error(const View& view, double fixed_m) {
    const auto middle_m = static_cast<float>(0.5 * (view.range_min_m + view.range_max_m));
    const double called_for_m = LeafSize(view, 0.0).at(middle_m);
    const double leaf_m = fixed_m > 0.0 ? fixed_m : called_for_m;
    const double openings = leaf_m / (view.elevation_rad * static_cast<double>(middle_m));
    return usual_share * view.relative_l1 * leaf_m / called_for_m * std::max(1.0, openings);
}

}  // namespace sonarsim
