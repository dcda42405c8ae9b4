#pragma once

#include <vector>

#include "visibility/slices/scan.h"
#include "visibility/view.h"

namespace sonarsim {

/// Expected error from bins that surface only just fills or only just misses, as a share of the
/// image's signal. A bin is as bright for a sliver of surface as for a wall, so rounding decides
/// about it, and neighbouring slices with the same rounding agree.
class EdgeBinError {
  public:
    explicit EdgeBinError(const View& view);

    /// Starts a beam; later calls of add() belong to it. Beams come in order.
    void begin_beam(int beam);

    /// Adds surface that is spread evenly over an interval of range. Its intensity follows from
    /// `reflection` and the sensor's distance from its plane.
    void add(const Interval& range_m, float area_m2, float height_m, float reflection);

    /// The expected error over the finished beams.
    double error() const { return signal_ > 0.0 ? error_ / signal_ : 0.0; }

    /// Ends the last beam.
    void finish() { end_beam(); }

  private:
    void end_beam();

    float per_m_;     ///< bins per metre
    float min_bins_;  ///< the least range, in bins
    int count_;
    int beam_ = -1;
    int first_;  ///< bins outside of [first_, last_] are dark
    int last_ = -1;
    // Padding: one dark bin before the beam's bins, and dark bins after them to fill a vector.
    std::vector<float> area_;  ///< bin i is at i + 1
    std::vector<float> echo_;  ///< area times intensity
    std::vector<int> touched_;
    double signal_ = 0.0;  ///< intensities of all bins of all beams
    double error_ = 0.0;   ///< intensities of the expected errors
};

}  // namespace sonarsim
