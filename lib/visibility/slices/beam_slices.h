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

/// The slices of one beam within a frame. They are added until they agree about what lies
/// between them.
class BeamSlices {
  public:
    /// All arguments must outlive it.
    BeamSlices(const View& view, std::span<const Material> materials, FrameScan& scan);

    /// Sees the beam that begins with gap `gap` of the frame, as far as the frame reaches. Its
    /// slices may disagree by `most`, a share of the signal. Returns the gap after the beam's last.
    /// Beams are to be seen in order.
    std::uint32_t see(std::uint32_t gap, double most);

    /// The slices of the beam, from low u to high.
    std::span<const SeenSlice* const> slices() const { return in_order_; }

    /// Of all beams so far.
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
        std::vector<std::uint32_t> trapezoids;
        bool with_inner = false;  ///< those that lie between its slices are among them
    };

    void see_gap(std::uint32_t gap);
    void split_where_wanted(std::uint32_t gap);
    void split(std::size_t i, float u);
    void refine(double most);
    void estimate(Between& between);
    bool alike(const SeenSlice& a, const SeenSlice& b) const;
    float width(const Between& between) const;
    float least_width(std::uint32_t gap) const;
    std::uint32_t new_slice();
    void put_in_order();

    const std::span<const Material> materials_;
    FrameScan& scan_;
    std::vector<SeenSlice> seen_;  ///< memory is reused; the first used_ are in use
    std::uint32_t used_ = 1;
    std::uint32_t border_ = 0;  ///< the slice behind the gap of the frame that was seen last
    std::uint32_t first_gap_ = 0;
    float beam_width_ = 0.0F;  ///< in u
    std::vector<Around> around_;
    std::vector<Between> between_;
    std::vector<const SeenSlice*> in_order_;
    MovedEnds ends_of_low_;
    MovedEnds ends_of_high_;
    RangeProfile low_;
    RangeProfile high_;
    float last_signal_ = 0.0F;  ///< of a whole beam
    Disagreement sum_;
    double beams_ = 0.0;
};

}  // namespace sonarsim
