#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// How large a leaf may be at a distance from the sensor.
class LeafSize {
  public:
    /// `fixed_m` is the edge of every leaf; 0: what the view calls for.
    LeafSize(const View& view, double fixed_m);

    /// The edge at a distance, m.
    float at(float distance_m) const;

  private:
    float fixed_m_;
    float by_bins_m_;     ///< what the range bins call for
    float by_beams_rad_;  ///< what the beams call for, where that is more
    float widest_rad_;    ///< however wide beams and bins are
    float largest_m_;
    float smallest_m_;
};

/// About the relative L1 of an image of this view; `fixed_m` as for LeafSize. The measured error is
/// 1.9 to 2.6 % with leaves of the size that the view calls for, and grows as the leaves do.
double estimated_octree_error(const View& view, double fixed_m);

}  // namespace sonarsim
