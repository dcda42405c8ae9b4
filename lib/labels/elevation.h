#pragma once

#include <span>
#include <vector>

#include "paper/accumulate.h"
#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Finds the elevation of the surface in the bins of a beam.
class ElevationFinder {
  public:
    /// Both must outlive the finder.
    ElevationFinder(std::span<const Material> materials, const RangeBins& bins)
        : materials_(materials), bins_(bins) {}

    /// The mean elevation of the echo of each bin and its standard deviation, rad; both are NaN in
    /// bins without an echo. Means are of sin(theta), weighted with area times intensity.
    void find(std::span<const Sample> samples, std::span<float> elevation_rad,
              std::span<float> spread_rad);

  private:
    /// Moments of sin(theta) by bin. Doubles, since a spread is a small difference of squares;
    /// arrays, so that loops vectorise.
    struct Moments {
        std::vector<double> echo, first, second;
    };

    void add(const Sample& sample);

    std::span<const Material> materials_;
    RangeBins bins_;
    Moments moments_;                   ///< 0 between calls
    int first_bin_ = 0, last_bin_ = 0;  ///< the bins [first, last) of this beam have an echo
};

}  // namespace sonarsim
