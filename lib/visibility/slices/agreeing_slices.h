#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/frame_scan.h"
#include "visibility/slices/range_profile.h"

namespace sonarsim {

/// How far neighbouring slices disagree about what lies between them, in intensities summed over
/// bins and beams.
struct Disagreement {
    double apart = 0.0;
    double signal = 0.0;  ///< what it is a share of

    double share() const { return signal > 0.0 ? apart / signal : 0.0; }
};

/// How far slices may disagree.
struct DisagreementLimit {
    double share;  ///< of the signal
    double lent;   ///< share of what the beams before left of it that a beam may use up as well
};

/// Sees the slices of a frame, a beam's worth at a time, and adds slices between them until they
/// agree about what lies between.
class AgreeingSlices {
  public:
    /// All arguments must outlive it.
    AgreeingSlices(const View& view, std::span<const Material> materials, FrameScan& scan);

    /// Sees the next gaps of the frame. False when there are none left.
    bool see_next(const DisagreementLimit& most);

    /// Of the slices seen so far, those that are new and whose strips are known at both sides, from
    /// low u to high.
    std::span<const SeenSlice* const> slices() const { return done_; }

    /// Of all gaps so far.
    const Disagreement& sum() const { return sum_; }

  private:
    /// What lies between two neighbouring slices; indices into seen_.
    struct Between {
        std::uint32_t low;
        std::uint32_t high;
        std::uint32_t gap;   ///< of the frame, in which it lies
        float apart = 0.0F;  ///< as of Disagreement
        float signal = 0.0F;
    };

    /// A gap of the frame, and the trapezoids that a slice in it may meet.
    struct Around {
        std::vector<std::uint32_t> of_slices;  ///< that one of its two slices meets
        std::vector<Candidate> all;            ///< once the gap is split
    };

    void see_gap(std::uint32_t gap);
    void split_where_wanted(std::uint32_t gap);
    void split(std::size_t i, float u);
    void refine(const DisagreementLimit& most);
    void estimate(Between& between);
    bool alike(const SeenSlice& a, const SeenSlice& b) const;
    float width(const Between& between) const;
    float least_width(std::uint32_t gap) const;
    std::uint32_t new_slice();
    void collect_done();

    const std::span<const Material> materials_;
    FrameScan& scan_;
    std::vector<SeenSlice> seen_;  ///< memory is reused; the first used_ are in use
    std::uint32_t used_ = 1;
    std::uint32_t last_ = 0;  ///< the slice of the frame that was seen last
    std::uint32_t next_gap_ = 0;
    std::uint32_t first_gap_ = 0;  ///< of those seen together
    float beam_width_ = 0.0F;      ///< in u
    std::vector<Around> around_;
    std::vector<Between> between_;
    std::vector<const SeenSlice*> done_;
    RangeProfile low_;
    RangeProfile high_;
    float last_signal_ = 0.0F;  ///< of a whole beam
    Disagreement sum_;
    double times_ = 0.0;  ///< that gaps were seen
};

}  // namespace sonarsim
