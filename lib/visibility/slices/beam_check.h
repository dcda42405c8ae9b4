#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// The beams that are checked, among those that may have errors.
enum class BeamsToCheck { drawn, all };

/// Views of few beams and those with fine goals are checked whole at first.
BeamsToCheck beams_to_check(const View& view);

/// Measures the error of a ping: drawn beams are seen again by twice the slices, in smaller
/// patches. The image of a drawn beam is that of its check.
///
/// Let A be the image of a beam by n slices, C that by these and as many more, at random places
/// between them, and B the truth. The sum of |A - C| over the bins, D, is known; |C - B| is wanted
/// for drawn beams, |A - B| for the others.
///
/// - The new slices have an independent error of the same size: C is the mean of two images, and
///   A - C half the difference of their errors. So |C - B| = D and |A - B| = sqrt(2) D on average.
/// - Both errors have one sign and fall as 1/n: |C - B| = D. As 1/n^2: |C - B| = D / 3.
/// - A bin is lit by a bar that takes up the share p of the beam, and dark without it. The slices
///   miss it with the probability exp(-n p), both sets with exp(-2 n p); so |C - B| is
///   D / (exp(n p) - 1). For n p = 1, a bar as wide as the mean distance of two slices, that is
///   0.58 D. Thinner bars are found by one more slice, through a triangle that is drawn by its area
///   among those that no slice meets.
///
/// The first case is taken for all of them. Then |C - B| and |A - C| of a bin are the sizes of two
/// independent variables, normal with the same variance s^2, whose sum over the bins is that of
/// (A - C)^2. Their sums over the bins differ by a standard deviation of 0.853 s: much of D if few
/// bins decide, and little of it otherwise.
///
/// Patches of C are as small as those of an image with a third of the error goal, and not joined
/// over slices, so D has the errors of A's patches as well.
///
/// One of `step` beams is drawn, at random among so many neighbours that may have errors. The sum
/// of `step` D over the drawn beams is an unbiased estimate of the sum over all of them: which
/// beams are drawn is independent of their errors. Beams in which neighbouring slices predict the
/// same and no triangle lies between them are their own check.
class BeamCheck {
  public:
    /// All arguments but `view` must outlive it.
    BeamCheck(const View& view, BeamsToCheck which, const FrameScan& scan,
              std::span<const Material> materials);

    /// Makes the image of the last beam that was scanned if it is drawn. `closely`: more beams are
    /// drawn from now on. Returns true if it was drawn.
    bool look_at(AdaptiveSlices& adaptive, bool closely);

    /// Hands over the image of the last beam, which was drawn.
    void hand_over(BeamErrors& errors) const;

    /// The samples of the last beam, which was drawn.
    const std::vector<Sample>& samples() const { return samples_; }

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
};

/// The error of an image as a share of its signal, as the distances tell it.
double likely_error(const BeamErrors& errors);

/// Upper limit of the error of an image, as a share of its signal, with a confidence of 95 % as far
/// as the draw of beams and the independence of bins are concerned.
double estimated_error(const BeamErrors& errors);

}  // namespace sonarsim
