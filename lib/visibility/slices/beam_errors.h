#pragma once

#include "visibility/slices/beam_sums.h"

namespace sonarsim {

/// The image of a ping as its beams are finished, and two parts of its error as shares of the
/// image's signal:
///
/// - Edge bins, which surface only just fills or only just misses. A bin is as bright for a sliver
///   of surface as for a wall, so rounding decides about it, and all slices have the same rounding.
/// - The distance of drawn beams from their check, an image by more slices (beam_check.h). The
///   check is the image of these beams.
class BeamErrors {
  public:
    explicit BeamErrors(const View& view);

    /// Starts a beam; what is added to sums() or by add_check() later belongs to it. Beams come in
    /// order.
    void begin_beam(int beam);

    BeamSums& sums() { return sums_; }

    /// Adds surface of the beam's check. The beam was drawn and stands for `weight` beams.
    void add_check(const BeamSums& check, double weight);

    /// The expected error of edge bins over the finished beams.
    double edge_bins() const { return signal_ > 0.0 ? edge_bins_ / signal_ : 0.0; }

    /// The distance of the drawn beams from their checks.
    double of_checked() const { return signal_ > 0.0 ? checked_ / signal_ : 0.0; }

    /// The root of the sum over their bins of the squared distances.
    double root_of_squares() const;

    /// The same with runs of neighbouring bins that are all too bright or all too dark instead of
    /// bins.
    double root_of_runs() const;

    /// The number of bins with an echo in the finished beams.
    double occupied_bins() const { return occupied_; }

    /// The same per finished beam.
    double bins_per_beam() const { return beam_ > 0 ? occupied_ / beam_ : 0.0; }

    /// The distance of the other beams from checks of theirs, estimated from the drawn ones.
    double of_others() const { return signal_ > 0.0 ? others_ / signal_ : 0.0; }

    /// Standard deviation of of_others() from the draw of beams.
    double others_deviation() const;

    /// Ends the last beam.
    void finish() { end_beam(); }

  private:
    void end_beam();
    void add_edge_bins(BeamSums& sums);

    BeamSums sums_;
    BeamSums check_;
    double weight_ = 0.0;  ///< the number of beams that this one stands for; 0: it was not drawn
    int beam_ = -1;
    double signal_ = 0.0;  ///< intensities of all bins of all beams
    double edge_bins_ = 0.0;
    double checked_ = 0.0;
    double squares_ = 0.0;
    double runs_ = 0.0;
    double occupied_ = 0.0;
    double others_ = 0.0;
    double variance_ = 0.0;
    /// The weighted distance of the last beam that stood for others; negative: there is none.
    double last_ = -1.0;
};

}  // namespace sonarsim
