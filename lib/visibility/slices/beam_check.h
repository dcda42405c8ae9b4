#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// Measures the error of a ping: drawn beams are seen again by twice the slices, in smaller
/// patches.
///
/// Let A be the image of a beam by n slices, C that by these and as many more, at random places
/// between them, and B the truth. The sum of |A - C| over the bins, D, is known; |A - B| is wanted.
///
/// - The new slices have an independent error of the same size: C is the mean of two images, so
///   A - C is half the difference of their errors, and |A - B| = sqrt(2) D on average.
/// - Both errors have one sign and fall as 1/n: |A - B| = 2 D. As 1/n^2: |A - B| = 4/3 D.
/// - A bin is lit by a bar that takes up the share p of the beam, and dark without it. The slices
///   miss it with the probability exp(-n p), both sets with exp(-2 n p); so |A - B| is
///   D / (1 - exp(-n p)). For n p = 1, a bar as wide as the mean distance of two slices, that is
///   1.58 D. Thinner bars are found by one more slice, through a triangle that is drawn by its area
///   among those that no slice meets.
///
/// The factor of the bar lies between the others and is taken for all of them. Patches of C are as
/// small as those of an image with a third of the error goal, and not joined over slices, so D has
/// the errors of A's patches as well.
///
/// One of `step` beams is drawn, at random among so many neighbours that may have errors. The sum
/// of `step` D over the drawn beams is an unbiased estimate of the sum over all of them: which
/// beams are drawn is independent of their errors. Beams in which neighbouring slices predict the
/// same and no triangle lies between them are their own check.
class BeamCheck {
  public:
    /// All arguments but `view` must outlive it.
    BeamCheck(const View& view, const FrameScan& scan, std::span<const Material> materials);

    /// Makes the image of the last beam that was scanned if it is drawn. `closely`: more beams are
    /// drawn from now on.
    void look_at(AdaptiveSlices& adaptive, bool closely);

    /// Hands over the image of the last beam if it was drawn.
    void hand_over(BeamErrors& errors) const;

  private:
    std::vector<Sample> samples_;
    BinSums sums_;
    QuadSampler sampler_;
    StripQuads quads_;
    const std::uint32_t calm_step_;  ///< one of so many uncertain beams is drawn
    /// Several frames may share a beam of a view with one or two, and make its image together.
    const bool all_;
    std::uint32_t uncertain_ = 0;  ///< number of uncertain beams so far
    std::uint32_t begin_ = 0;      ///< the uncertain beams from here on,
    std::uint32_t step_ = 0;       ///< so many, are a block
    std::uint32_t next_ = 0;       ///< the one of the block that is drawn
    bool drawn_ = false;
};

/// Upper limit of the error of an image, as a share of its signal, with a confidence of 95 % as far
/// as the draw of beams is concerned.
double estimated_error(const BeamErrors& errors);

}  // namespace sonarsim
