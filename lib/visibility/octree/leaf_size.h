#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// Largest leaf edge at a distance from the sensor for the view's error goal.
class LeafSize {
  public:
    /// `fixed_m` is the edge of all leaves; 0: the view determines it.
    LeafSize(const View& view, double fixed_m);

    /// The edge at a distance, m.
    float at(float distance_m) const;

    /// Leaves twice as large everywhere, which is the next coarser level of the tree.
    LeafSize twice() const;

  private:
    float fixed_m_;
    float by_bins_m_;     ///< limit by the range bins
    float by_beams_rad_;  ///< limit by the beams, if that is larger
    float widest_rad_;    ///< limit by angle, for wide beams and bins
    float largest_m_;
    float smallest_m_;
};

/// Rough relative L1 of an image of this view, before any ping; `fixed_m` as for LeafSize. It is
/// off by a factor of up to 4 depending on the scene; GoalCheck measures it.
double estimated_octree_error(const View& view, double fixed_m);

}  // namespace sonarsim
