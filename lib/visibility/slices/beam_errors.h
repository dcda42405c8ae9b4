#pragma once

#include <cstddef>
#include <vector>

#include "visibility/slices/beam_sums.h"

namespace sonarsim {

/// The image of a ping as its beams are finished, and two parts of its error as shares of the
/// image's signal:
///
/// - Edge bins, which surface only just fills or only just misses. A sliver of surface makes a bin
///   as bright as a wall does, so rounding decides, and all slices have the same rounding.
/// - The distance of beams from their checks, which are images by more slices (beam_check.h). A
///   checked beam gets the image of its check.
class BeamErrors {
  public:
    explicit BeamErrors(const View& view);

    /// Starts a beam: later additions to sums() belong to it. Beams come in order.
    void begin_beam(int beam);

    BeamSums& sums() { return sums_; }

    /// Ends the last beam.
    void finish() { end_beam(); }

    /// Starts a draw among the beams that were not checked, after finish(). The errors of unchecked
    /// beams are estimated from the last draw alone.
    void start_draw();

    /// Adds the check of a beam that had none, was drawn, and stands for `weight` beams.
    void check(int beam, BeamSums& check, double weight);

    /// The expected error of edge bins over the finished beams.
    double edge_bins() const { return of_signal(total_.edge_bins); }

    /// The same if no beam had been checked.
    double edge_bins_before_checks() const {
        return before_checks_.signal > 0.0 ? before_checks_.edge_bins / before_checks_.signal : 0.0;
    }

    /// The distance of the checked beams from their checks.
    double of_checked() const { return of_signal(checked_.absolute); }

    /// The root of the sum of squared distances over the bins of the checked beams.
    double root_of_squares() const;

    /// The same over runs of neighbouring bins that are all too bright or all too dark.
    double root_of_runs() const;

    /// The number of bins with an echo in the finished beams.
    double occupied_bins() const { return total_.occupied; }

    /// The distance of the other beams from their checks, estimated from the drawn beams.
    double of_others() const { return of_signal(others_); }

    /// Standard deviation of of_others() from the draw of beams.
    double others_deviation() const;

    /// The number of beams of the last draw that stand for others.
    int draws() const { return draws_; }

  private:
    struct Bins {
        double signal = 0.0;  ///< sum of the intensities
        double edge_bins = 0.0;
        double occupied = 0.0;
    };

    /// A beam before its check.
    struct Finished {
        Bins bins;
        int first = 0;
        std::size_t begin = 0;  ///< offset into intensities_
        std::size_t count = 0;
    };

    void end_beam();
    static Bins bins_of(BeamSums& sums);
    void add_distance(const BeamImage& image, const BeamSums& check);
    static void add(const Bins& bins, double times, Bins& sum);
    double of_signal(double x) const { return total_.signal > 0.0 ? x / total_.signal : 0.0; }

    BeamSums sums_;
    int beam_ = -1;
    Bins before_checks_;
    Bins total_;
    BeamDistance checked_;
    double others_ = 0.0;
    double variance_ = 0.0;
    int draws_ = 0;
    double last_ = 0.0;               ///< the weighted distance of the last of these draws
    std::vector<Finished> finished_;  ///< one per beam
    std::vector<float> intensities_;

    std::vector<float> of_check_;  ///< one beam
};

}  // namespace sonarsim
