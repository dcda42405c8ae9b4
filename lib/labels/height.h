#pragma once

#include <span>
#include <vector>

#include "core/pose.h"
#include "scene/placing/bottom.h"
#include "trace/surface_echoes.h"

namespace sonarsim {

/// Finds the height above the bottom of the surface in the bins of a beam.
class HeightFinder {
  public:
    /// The bottom must outlive the finder. Without a bottom nothing has a height.
    HeightFinder(const RangeBins& bins, const Bottom* bottom, const Pose& T_world_sensor)
        : bins_(bins), bottom_(bottom), T_world_sensor_(T_world_sensor) {}

    /// The mean height of the echo of each bin, m, weighted with the echo: the distance to the next
    /// surface of the bottom straight below. 0 for the bottom itself, NaN in bins
    /// without an echo or without a bottom below. The bottom below one patch is taken as level.
    void find(std::span<const EchoPatch> patches, std::span<float> height_m);

  private:
    struct Sums {
        double echo = 0.0, height = 0.0;
    };

    void add(const EchoPatch& patch, const Eigen::Vector3f& up);

    RangeBins bins_;
    const Bottom* bottom_;
    Pose T_world_sensor_;
    std::vector<Sums> sums_;            ///< 0 between calls
    int first_bin_ = 0, last_bin_ = 0;  ///< the bins [first, last) of this beam have an echo
};

}  // namespace sonarsim
