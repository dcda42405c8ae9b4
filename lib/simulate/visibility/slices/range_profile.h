#pragma once

#include <span>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/visibility/slices/frame_scan.h"
#include "simulate/visibility/slices/moved_ends.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The noise-free echo of one vertical of the picture plane, bin by bin: the image of a beam in
/// which all verticals were equal to this one.
class RangeProfile {
  public:
    explicit RangeProfile(const View& view);

    /// Replaces the profile by that of a slice's spans, moved to the vertical at ends.u.
    void set(const FrameScan& scan, std::span<const Material> materials,
             std::span<const VisibleSpan> spans, const MovedEnds& ends);

    /// Replaces the profile by that of pieces, evenly spread over a beam of width `beam_u`.
    void set(std::span<const UnseenPiece* const> pieces, float beam_u);

    /// The sum over the bins of the change of the mean of two profiles when a third is added.
    static float change(const RangeProfile& a, const RangeProfile& b, const RangeProfile& added);

    /// The sum of the bins' intensities.
    float sum() const { return sum_; }

    /// The sum over the bins of the absolute difference of two profiles.
    static float difference(const RangeProfile& a, const RangeProfile& b);

  private:
    void clear();
    void add(float from, float to, float weight, float height_m, float reflection);
    void finish();

    float min_bins_;  ///< the least range, in bins
    float per_m_;     ///< bins per metre
    int bins_;
    int first_ = 0;  ///< bins outside of [first_, last_) are empty
    int last_ = 0;
    float sum_ = 0.0F;
    std::vector<float> per_range_;  ///< 1 / range of each bin, 1/m
    std::vector<float> weight_;
    std::vector<float> echo_;  ///< echo, and after finish() the intensity
};

}  // namespace sonarsim
