#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/visibility/slices/frame_scan.h"
#include "simulate/visibility/slices/range_profile.h"

namespace sonarsim {

/// Difference of neighbouring slices' predictions midway between them, in intensities summed over
/// bins and beams.
struct SliceError {
    double difference = 0.0;
    double signal = 0.0;  ///< sum of the intensities
};

/// The border between the strips of two neighbouring slices: midway, or where all surface of one of
/// them ends, so that the other's surface continues up to that end.
float strip_border(const SliceResult& low, const SliceResult& high);

/// An interval between two neighbouring slices of a beam.
struct Subgap {
    std::uint32_t low;  ///< index of a slice
    std::uint32_t high;
    std::uint32_t gap;        ///< index of the frame's gap that contains it
    float difference = 0.0F;  ///< as in SliceError
    float signal = 0.0F;
    float split_u = 0.0F;  ///< the next slice goes here
};

/// A gap of the frame, and the trapezoids that a slice in it may meet.
struct AroundGap {
    std::vector<std::uint32_t> of_slices;  ///< trapezoids that its own slices meet
    std::vector<std::uint32_t> all;        ///< filled when the gap is split
    std::vector<UnseenPiece> unseen;       ///< pieces that its own slices do not meet
};

/// Scans the slices of a frame, one beam at a time, and adds slices between them until neighbours
/// agree.
class AdaptiveSlices {
  public:
    /// All arguments must outlive it.
    AdaptiveSlices(const View& view, std::span<const Material> materials, FrameScan& scan);

    /// Scans the next gaps of the frame; neighbours then differ by at most this share of the
    /// signal. Returns false if there are none left.
    bool scan_next(double max_share);

    /// The new slices whose strips are complete on both sides, from low u to high.
    std::span<const SliceResult* const> slices() const { return done_; }

    /// The sum over all gaps so far.
    const SliceError& sum() const { return sum_; }

  private:
    void scan_gap(std::uint32_t gap);
    void split_where_requested(std::uint32_t gap);
    void split(std::size_t i, float u);
    void refine(double max_share);
    void estimate(Subgap& subgap);
    void add_unseen(Subgap& subgap);
    void find_outstanding(const Subgap& subgap);
    bool is_nearer_than_predicted(const UnseenPiece& piece, const SliceResult& near,
                                  const MovedEnds& ends) const;
    bool alike(const SliceResult& a, const SliceResult& b) const;
    const std::vector<std::uint32_t>& candidates(std::uint32_t gap);
    float width(const Subgap& subgap) const;
    float min_width(std::uint32_t gap) const;
    std::uint32_t new_slice();
    void collect_done();

    const std::span<const Material> materials_;
    FrameScan& scan_;
    std::vector<SliceResult> results_;  ///< memory is reused; the first used_ are in use
    std::uint32_t used_ = 1;
    std::uint32_t last_ = 0;  ///< the last slice of the frame that was scanned
    std::uint32_t next_gap_ = 0;
    std::uint32_t first_gap_ = 0;  ///< first of the gaps scanned together
    float beam_width_ = 0.0F;      ///< in u
    std::vector<AroundGap> around_;
    std::vector<Subgap> subgaps_;
    std::vector<const SliceResult*> done_;
    RangeProfile low_;
    RangeProfile high_;
    RangeProfile unseen_;
    std::vector<const UnseenPiece*> outstanding_;  ///< in one subgap
    const float same_range_m_;
    float last_signal_ = 0.0F;  ///< signal of a whole beam
    SliceError sum_;
    double times_ = 0.0;  ///< number of refinements so far
};

}  // namespace sonarsim
