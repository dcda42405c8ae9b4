#pragma once

#include <span>

#include "simulate/labels/range_path.h"
#include "simulate/trace/surface_echoes.h"

namespace sonarsim {

/// Finds the elevation of the surface in the bins of some beams.
class ElevationFinder {
  public:
    /// `rows`: the number of beams that are summed at once.
    ElevationFinder(const RangeBins& bins, int rows);

    /// Begins the next patch.
    void begin(const EchoPatch& patch, const RangePath& path);
    /// Computes these bins of the patch.
    void cover(const CoveredBins& covered);
    /// Adds an echo of the patch to these bins of a row.
    void add(std::uint32_t row, double echo, const CoveredBins& covered);

    /// The mean elevation of the echo of each bin and its standard deviation, rad. Means are of
    /// sin(theta), weighted with the echo. Bins without an echo are left as they are, or NaN.
    /// Clears the row.
    void find(std::uint32_t row, std::span<float> elevation_rad, std::span<float> spread_rad);

  private:
    /// The echo and its moments of sin(theta). Doubles, since a spread is a small difference of
    /// squares.
    BinSumRows<3> sums_;
    // This patch:
    double rise_m_ = 0.0, slope_ = 0.0, variance_at_range_ = 0.0;
    std::array<double, CoveredBins::at_once> mean_{}, square_{};  ///< sin(theta), by bin
};

}  // namespace sonarsim
