#pragma once

#include <vector>

#include "visibility/slices/scan.h"
#include "visibility/view.h"

namespace sonarsim {

/// The error that is to be expected of bins that surface only just reaches, or only just does not,
/// as a share of the image's signal. A bin is as bright for a sliver of surface as for a wall, so
/// that the last digits decide about it, and neighbouring slices, which share them, agree.
class SliverBins {
  public:
    explicit SliverBins(const View& view);

    /// What is added from here on lies in this beam. Beams come in order.
    void begin_beam(int beam);

    /// Adds surface that spans a part of the range evenly. `reflection` and its height above the
    /// sensor make its intensity.
    void add(const Extent& range_m, float area_m2, float height_m, float reflection);

    /// Of the beams that are full.
    double error() const { return signal_ > 0.0 ? wrong_ / signal_ : 0.0; }

    /// Ends the last beam.
    void finish() { end_beam(); }

  private:
    void end_beam();

    float per_m_;     ///< bins
    float min_bins_;  ///< the least range, in bins
    int count_;
    int beam_ = -1;
    int first_;  ///< the bins that are lit lie in [first_, last_]
    int last_ = -1;
    // A dark bin stands before those of the beam, and dark ones that fill a vector behind.
    std::vector<float> area_;  ///< of bin i at i + 1
    std::vector<float> echo_;  ///< area times intensity
    std::vector<int> touched_;
    double signal_ = 0.0;  ///< intensities of all bins, of all beams
    double wrong_ = 0.0;   ///< of those that are likely wrong
};

}  // namespace sonarsim
