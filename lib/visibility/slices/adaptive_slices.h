#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/frame_scan.h"
#include "visibility/slices/range_profile.h"

namespace sonarsim {

struct KeptGaps;

/// Difference of neighbouring slices' predictions midway between them, in intensities summed over
/// bins and beams.
struct SliceError {
    double difference = 0.0;
    double signal = 0.0;  ///< sum of the intensities

    double share() const { return signal > 0.0 ? difference / signal : 0.0; }
};

/// Limit of the difference.
struct SliceErrorLimit {
    double share;       ///< share of the signal
    double carry_over;  ///< share of the allowance left by earlier beams that a beam may use
};

/// The strip that a slice represents, between its ends moved to both sides.
struct Strip {
    const SliceResult* slice;
    const MovedEnds* low;
    const MovedEnds* high;
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
    std::vector<Candidate> all;            ///< filled when the gap is split
    std::vector<UnseenPiece> unseen;       ///< pieces that its own slices do not meet
};

/// Scans the slices of a frame, one beam at a time, and adds slices between them until neighbours
/// agree.
class AdaptiveSlices {
  public:
    /// All arguments must outlive it.
    AdaptiveSlices(const View& view, std::span<const Material> materials, FrameScan& scan);

    /// Scans the next gaps of the frame. Returns false if there are none left.
    bool scan_next(const SliceErrorLimit& most);

    /// The first of the gaps that were scanned last.
    std::uint32_t first_gap() const { return first_gap_; }

    /// The new slices whose strips are complete on both sides, from low u to high.
    std::span<const SliceResult* const> slices() const { return done_; }

    /// True if surface other than that predicted may lie between the slices of the last gaps.
    bool uncertain() const;

    /// The strips of the last gaps with more slices wherever two may miss something between them:
    /// one at a random place, and one through a triangle that no slice meets, drawn by its area.
    /// The slices themselves stay as they are.
    std::span<const Strip> check_strips();

    /// Appends the last gaps to the kept ones, for a later check.
    void keep(KeptGaps& out) const;

    /// Makes kept gaps the last ones, for check_strips(). Nothing can be scanned afterwards.
    void restore(const KeptGaps& kept, std::size_t index);

    /// The sum over all gaps so far.
    const SliceError& sum() const { return sum_; }

  private:
    void scan_gap(std::uint32_t gap);
    void split_where_requested(std::uint32_t gap);
    void split(std::size_t i, float u);
    void refine(const SliceErrorLimit& most);
    void estimate(Subgap& subgap);
    void add_unseen(Subgap& subgap);
    void find_outstanding(const Subgap& subgap);
    bool is_nearer_than_predicted(const UnseenPiece& piece, const SliceResult& near,
                                  const MovedEnds& ends) const;
    bool alike(const SliceResult& a, const SliceResult& b) const;
    bool certain(const Subgap& subgap) const;
    void scan_check();
    void scan_check_at(float u, const Subgap& subgap);
    float through_unseen(const Subgap& subgap, float share) const;
    float beam_border(std::uint32_t gap) const;
    const std::vector<Candidate>& candidates(std::uint32_t gap);
    float width(const Subgap& subgap) const;
    float least_width(std::uint32_t gap) const;
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
    std::vector<SliceResult> check_;  ///< slices of the check; the first check_used_ are in use
    std::size_t check_used_ = 0;
    std::vector<const SliceResult*> checked_;  ///< slices of the gaps and of their check, by u
    std::vector<MovedEnds> borders_;           ///< two for each of checked_
    std::vector<Strip> strips_;
    RangeProfile low_;
    RangeProfile high_;
    RangeProfile unseen_;
    std::vector<const UnseenPiece*> outstanding_;  ///< in one subgap
    const float same_range_m_;
    float last_signal_ = 0.0F;  ///< signal of a whole beam
    SliceError sum_;
    double last_difference_ = 0.0;
    double times_ = 0.0;  ///< number of refinements so far
};

}  // namespace sonarsim
