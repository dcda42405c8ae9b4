#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// How large a leaf may be at a distance from the sensor for the view's error goal.
class LeafSize {
  public:
    /// `fixed_m` is the edge of every leaf; 0: what the view calls for.
    LeafSize(const View& view, double fixed_m);

    /// The edge at a distance, m.
    float at(float distance_m) const;

    /// Leaves twice as large everywhere: the next level of the tree.
    LeafSize twice() const;

  private:
    float fixed_m_;
    float by_bins_m_;     ///< what the range bins call for
    float by_beams_rad_;  ///< what the beams call for, where that is more
    float widest_rad_;    ///< however wide beams and bins are
    float largest_m_;
    float smallest_m_;
};

/// About the relative L1 of an image of this view, before anything is seen; `fixed_m` as for
/// LeafSize. Off by a factor of up to 4 from scene to scene: GoalCheck knows better.
double estimated_octree_error(const View& view, double fixed_m);

}  // namespace sonarsim
