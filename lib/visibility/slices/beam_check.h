#pragma once

#include <span>
#include <vector>

#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// Checks beams by twice the slices, in smaller patches. A checked beam gets the image of its
/// check.
///
/// Let A be the image of a beam by n slices, C its image by 2 n slices, the new ones at random
/// places between the old ones, and B the true image. The sum D of |A - C| over the bins is known.
/// The error of a checked beam is |C - B|, that of another beam |A - B|.
///
/// - The new slices have an independent error of the same size: C is the mean of two images, and
///   A - C half the difference of their errors. So |C - B| = D and |A - B| = sqrt(2) D on average.
/// - Both errors have one sign and fall as 1/n: |C - B| = D. As 1/n^2: |C - B| = D / 3.
/// - A bin is occupied by a bar as wide as the share p of the beam, and empty without it. The n
///   slices miss the bar with the probability exp(-n p), all 2 n slices with exp(-2 n p). So
///   |C - B| is D / (exp(n p) - 1): 0.58 D for n p = 1, a bar as wide as the mean distance of two
///   slices. Thinner bars are found by one more slice, through a triangle that no slice meets; it
///   is drawn with a probability proportional to its area.
///
/// The first case is assumed. Then the errors |C - B| and |A - C| of a bin are the magnitudes of
/// two independent normal variables with the same variance. Let s^2 be the sum of (A - C)^2 over
/// the bins. The sums of the two magnitudes over the bins differ by a standard deviation of 0.853
/// s: much of D if few bins decide, and little of it otherwise.
///
/// Bars of p = 0.22 / n have an error of 4 D, and with four times the slices of 0.7 D. If few bins
/// decide, one such bar may have most of the error. So the first pass over such a view suffices
/// only if the estimate is below a quarter of the goal, and the second has four times the slices.
///
/// C has the patches of a third of the error goal and does not join them over slices. So D contains
/// the errors of A's patches as well.
///
/// A beam needs no check if neighbouring slices predict the same image and no triangle lies between
/// them.
class BeamCheck {
  public:
    /// The scan, the materials and the samples must outlive it.
    BeamCheck(const View& view, const FrameScan& scan, std::span<const Material> materials,
              std::vector<Sample>& samples);

    /// Makes the image of the last beam of `adaptive`, and appends its samples. The image is valid
    /// until the next call.
    BeamSums& check_beam(AdaptiveSlices& adaptive);

  private:
    BeamSums sums_;
    QuadSampler sampler_;
    StripQuads quads_;
};

/// The expected error of an image as a share of its signal.
double likely_error(const BeamErrors& errors);

/// The same if all beams were checked.
double likely_error_if_checked(const BeamErrors& errors);

/// Upper limit of the error of an image as a share of its signal. The confidence is 95 % if bins
/// are independent. The variance of few draws is itself uncertain, so Student's distribution gives
/// their limit.
double estimated_error(const BeamErrors& errors);

/// True if so few bins have an echo that the bins of one bar or edge may have an error above the
/// goal.
bool few_bins_decide(const BeamErrors& errors, double goal);

/// The number of bins that one cause may make wrong, as a share of the bins that may be wrong at
/// the goal.
double share_with_one_cause(const BeamErrors& errors, double goal);

/// The same limit as estimated_error() if few bins decide and all beams were checked. Neighbours
/// that all became brighter or all darker have one cause, so runs of them are independent, not
/// bins. D is the sum over as many equal runs as (D / r)^2, where r is the root of the sum of the
/// squared changes of all runs. The variance of so few is itself uncertain, so Student's
/// distribution with as many degrees of freedom gives the limit.
double estimated_error_of_few_bins(const BeamErrors& errors);

/// The largest estimate that suffices after a pass over a view in which few bins decide. The first
/// pass is 1.
double pass_limit_of_few_bins(double goal, int pass);

}  // namespace sonarsim
