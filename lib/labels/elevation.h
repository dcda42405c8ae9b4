#pragma once

#include <span>
#include <vector>

#include "trace/surface_echoes.h"

namespace sonarsim {

/// Finds the elevation of the surface in the bins of a beam.
class ElevationFinder {
  public:
    explicit ElevationFinder(const RangeBins& bins) : bins_(bins) {}

    /// The mean elevation of the echo of each bin and its standard deviation, rad; both are NaN in
    /// bins without an echo. Means are of sin(theta), weighted with the echo.
    void find(std::span<const EchoPatch> patches, std::span<float> elevation_rad,
              std::span<float> spread_rad);

  private:
    /// Moments of sin(theta) by bin. Doubles, since a spread is a small difference of squares;
    /// arrays, so that loops vectorise.
    struct Moments {
        std::vector<double> echo, first, second;
    };

    void add(const EchoPatch& patch);

    RangeBins bins_;
    Moments moments_;                   ///< 0 between calls
    int first_bin_ = 0, last_bin_ = 0;  ///< the bins [first, last) of this beam have an echo
};

}  // namespace sonarsim
