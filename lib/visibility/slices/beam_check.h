#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_draw.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

/// The beams that are checked, among those that may have errors.
enum class BeamsToCheck { drawn, half, all };

/// Views of few beams and those with fine goals are checked whole at first.
BeamsToCheck beams_to_check(const View& view);

/// Measures the error of a ping. Some beams are drawn at random and checked by twice the slices, in
/// smaller patches. A checked beam keeps the image of its check.
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
/// decide, one such bar may have most of the error. So the first look at such a view suffices only
/// if the estimate is below a quarter of the goal, and the second has four times the slices.
///
/// C has the patches of a third of the error goal and does not join them over slices. So D contains
/// the errors of A's patches as well.
///
/// Beams that may have errors are drawn (beam_draw.h), twice as often if their slices disagree
/// three times as much as the others' on average. The draw is independent of the errors, so the sum
/// of D over the drawn beams, each times the number of beams that it stands for, is an unbiased
/// estimate of the sum over all beams, however badly the disagreement predicts D. A beam needs no
/// check if neighbouring slices predict the same image and no triangle lies between them.
class BeamCheck {
  public:
    /// All arguments but `view` must outlive it.
    BeamCheck(const View& view, BeamsToCheck which, const FrameScan& scan,
              std::span<const Material> materials);

    /// Makes the image of the last beam that was scanned if it is drawn. `closely`: more beams are
    /// drawn from now on. `wrong_bins`: the number of bins that may be wrong at the error goal, the
    /// goal times the expected bins with an echo. Returns true if it was drawn.
    bool look_at(AdaptiveSlices& adaptive, bool closely, double wrong_bins);

    /// Hands over the image of the last beam, which was drawn.
    void hand_over(BeamErrors& errors) const;

    /// The samples of the last beam, which was drawn.
    const std::vector<Sample>& samples() const { return samples_; }

  private:
    /// The rate at which a beam is drawn whose slices disagree by `difference`.
    double rate(double difference);

    std::vector<Sample> samples_;
    BeamSums sums_;
    QuadSampler sampler_;
    StripQuads quads_;
    /// The rate of a beam with the mean difference, while the errors are small.
    const double calm_rate_;
    /// Several frames may share a beam of a view with one or two, and make its image together.
    const bool all_;
    BeamDraw draw_;
    int uncertain_ = 0;         ///< number of uncertain beams so far
    double differences_ = 0.0;  ///< sum of their differences
    double weight_ = 0.0;       ///< the number of beams that the last one stands for
    /// look_at()'s arguments when the present unit of draw_ began (see BeamDraw::unit). The rate of
    /// the first beam is 1.
    bool closely_ = false;
    double wrong_bins_ = 0.0;
    std::uint32_t unit_ = 0;
};

/// The expected error of an image as a share of its signal.
double likely_error(const BeamErrors& errors);

/// Upper limit of the error of an image as a share of its signal. The confidence is 95 % if bins
/// are independent.
double estimated_error(const BeamErrors& errors);

/// True if so few bins have an echo that those which one bar or edge fills may have an error above
/// the goal.
bool few_bins_decide(const BeamErrors& errors, double goal);

/// The same limit as estimated_error() if few bins decide. Neighbours that all became brighter or
/// all darker have one cause, so runs of them are independent, not bins. D is the sum over as many
/// equal runs as (D / r)^2, where r is the root of the sum of the squared changes of all runs. The
/// variance of so few is itself uncertain, so Student's distribution with as many degrees of
/// freedom gives the limit.
double estimated_error_of_few_bins(const BeamErrors& errors);

/// The estimate that suffices in a pass over a view of which few bins decide. The first pass is 1.
double enough_for_few_bins(double goal, int pass);

}  // namespace sonarsim
