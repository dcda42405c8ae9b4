#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// How large a leaf may be at a distance from the sensor.
class LeafSize {
  public:
    /// `fixed_m` is the edge of every leaf; 0: what the bins of the view call for.
    LeafSize(const View& view, double fixed_m);

    /// The edge at a distance, m.
    float at(float distance_m) const;

  private:
    float fixed_m_;
    float per_m_;  ///< of distance
    float least_m_;
};

}  // namespace sonarsim
