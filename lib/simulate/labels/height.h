#pragma once

#include <cstdint>
#include <span>

#include "input/scene/placing/bottom.h"
#include "simulate/labels/range_path.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/surface_echoes.h"

namespace sonarsim {

/// Finds the height above the bottom of the surface in the bins of some beams.
class HeightFinder {
  public:
    /// `rows`: the number of beams that are summed at once. `is_bottom`: that of the scene. Both it
    /// and the bottom must outlive the finder.
    HeightFinder(const RangeBins& bins, int rows, const Bottom& bottom,
                 std::span<const std::uint8_t> is_bottom, const TruePlaces& places);

    /// Begins the next patch. False if there is no bottom below it, so that it has no height.
    bool begin(const EchoPatch& patch, const RangePath& path);
    /// Computes these bins of the patch.
    void cover(const CoveredBins& covered);
    /// Adds an echo of the patch to these bins of a row.
    void add(std::uint32_t row, double echo, const CoveredBins& covered);

    /// The mean height of the echo of each bin above the highest bottom below it. Bins without an
    /// echo or without a bottom are left as they are. Clears the row.
    void find(std::uint32_t row, std::span<float> height_m);

  private:
    bool lies_on_bottom(const Sample& sample) const;

    const Bottom& bottom_;
    std::span<const std::uint8_t> is_bottom_instance_;
    TruePlaces places_;
    Eigen::Vector3f up_;  ///< sensor frame
    BinSumRows<2> sums_;  ///< the echo, and the echo times the height
    // This patch:
    bool is_bottom_ = false;
    double height_m_ = 0.0, rise_m_ = 0.0, slope_ = 0.0;
    std::array<double, CoveredBins::at_once> mean_{};  ///< height, by bin
};

}  // namespace sonarsim
