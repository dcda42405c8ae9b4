#pragma once

#include "visibility/slices/bin_sums.h"

namespace sonarsim {

/// The image of a ping as its beams are finished, and two parts of its error as shares of the
/// image's signal:
///
/// - Edge bins, which surface only just fills or only just misses. A bin is as bright for a sliver
///   of surface as for a wall, so rounding decides about it, and all slices have the same rounding.
/// - The distance of drawn beams from their check: an image by more slices (beam_check.h).
class BeamErrors {
  public:
    explicit BeamErrors(const View& view);

    /// Starts a beam; what is added to sums() or by add_check() later belongs to it. Beams come in
    /// order.
    void begin_beam(int beam);

    BinSums& sums() { return sums_; }

    /// Adds surface of the beam's check. The beam was drawn from 1 / `share` beams.
    void add_check(const BinSums& check, double share);

    /// The expected error of edge bins over the finished beams.
    double edge_bins() const { return signal_ > 0.0 ? edge_bins_ / signal_ : 0.0; }

    /// The distance of the image from its check, estimated from the drawn beams.
    double to_check() const { return signal_ > 0.0 ? to_check_ / signal_ : 0.0; }

    /// Standard deviation of to_check() from the draw of beams.
    double to_check_deviation() const;

    /// Ends the last beam.
    void finish() { end_beam(); }

  private:
    void end_beam();
    void add_edge_bins();

    BinSums sums_;
    BinSums check_;
    double share_ = 0.0;  ///< one of 1 / share_ beams was drawn, this one; 0: not this one
    int beam_ = -1;
    double signal_ = 0.0;  ///< intensities of all bins of all beams
    double edge_bins_ = 0.0;
    double to_check_ = 0.0;
    double variance_ = 0.0;
    double last_ = -1.0;  ///< distance of the last drawn beam; negative: none
};

}  // namespace sonarsim
