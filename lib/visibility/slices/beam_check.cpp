#include "visibility/slices/beam_check.h"

#include <algorithm>
#include <cmath>

#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

// Views of up to this many beams are checked whole, since one of their beams may have a large share
// of the error. Set after a drawn lattice of 64 beams was missed with 16 of them.
constexpr int few_beams = 64;

// The number of drawn beams of others if all may have errors, and how many times more are drawn
// where it decides. Chosen for cost: by 16 beams the error is known to 43 % in the lifeboat and to
// 25 % in the wreck, and a third and two thirds of their pings had to be seen again.
constexpr int drawn_beams = 32;
constexpr double more_if_close = 2.0;

// A beam's rate is this share of the calm rate at least; the rest of it grows with the disagreement
// of the beam's slices, up to so many times the mean. Chosen on the lifeboat, the wreck and the
// tank, whose estimates have 0.71, 0.83 and 0.87 of the standard deviation that equal rates give.
constexpr double least_share_of_rate = 0.5;
constexpr double most_times_the_mean = 8.0;

// Errors per distance of a checked beam, whose check is returned, and of another beam; see
// BeamCheck.
constexpr double error_if_checked = 1.0;
constexpr double error_if_not = 1.414;

// Standard deviation of |x| - |y| for two independent normal variables, in theirs:
// sqrt(2 (1 - 2 / pi)).
constexpr double deviation_of_bins = 0.853;

// Standard deviations of a one-sided limit with a confidence of 95 %.
constexpr double deviations = 1.645;

// A bar or an edge that slices misplace changes several neighbouring bins. Fewer bins than this may
// be wrong by one cause. Chosen.
constexpr double bins_of_one_cause = 8.0;

// The first look at a view of few bins suffices if its estimate is below this share of the goal;
// see BeamCheck.
constexpr double enough_at_first = 0.25;

// Error of the check's own patches: boxes in range for curved surface. It is error_of_shapes() in
// slices_engine.cpp at its finest, which was fitted to the tank and the lifeboat
// (docs/notes/2026-11-21-slices-estimate.md).
constexpr double error_of_fine_patches = 0.0023;

/// Student's quantile for the confidence of `deviations`: the first terms of its series in 1 /
/// degrees. It is too small by 0.1 % for 10 degrees, 2 % for 3, 6 % for 2 and 27 % for 1.
double student(double degrees) {
    constexpr double z = deviations;
    constexpr double z3 = z * z * z;
    constexpr double first = (z3 + z) / 4.0;
    constexpr double second = (5.0 * z3 * z * z + 16.0 * z3 + 3.0 * z) / 96.0;
    return z + (first + second / degrees) / degrees;
}

double calm_rate(const View& view, BeamsToCheck which) {
    switch (which) {
        case BeamsToCheck::drawn:
            return static_cast<double>(drawn_beams) / view.beams;
        case BeamsToCheck::half:
            return 0.5;
        case BeamsToCheck::all:
            break;
    }
    // Whatever the slices' disagreement is, the rate is 1.
    return 1.0 / least_share_of_rate;
}

/// The patches of the check are those of a third of the error goal at most.
PatchLimits fine_limits(View view) {
    view.relative_l1 = std::min(view.relative_l1 / 3.0, 0.01);
    return patch_limits(view);
}

}  // namespace

BeamsToCheck beams_to_check(const View& view) {
    return view.beams <= few_beams || !is_coarse(view.relative_l1) ? BeamsToCheck::all
                                                                   : BeamsToCheck::drawn;
}

BeamCheck::BeamCheck(const View& view, BeamsToCheck which, const FrameScan& scan,
                     std::span<const Material> materials)
    : sums_(view),
      sampler_(scan, materials, fine_limits(view), sums_, samples_),
      quads_(scan, fine_limits(view), sampler_),
      calm_rate_(calm_rate(view, which)),
      all_(view.beams <= 2) {}

double BeamCheck::rate(double difference) {
    ++uncertain_;
    differences_ += difference;
    const double mean = differences_ / uncertain_;
    const double times = mean > 0.0 ? std::min(difference / mean, most_times_the_mean) : 1.0;
    const double own = least_share_of_rate + (1.0 - least_share_of_rate) * times;
    // Drawn beams of too few bins would miss the errors of others: they have at least
    // bins_of_one_cause wrong bins if the image just meets its goal.
    const double least = bins_of_one_cause / std::max(wrong_bins_, bins_of_one_cause);
    return std::max((closely_ ? more_if_close : 1.0) * calm_rate_ * own, least);
}

bool BeamCheck::look_at(AdaptiveSlices& adaptive, bool closely, double wrong_bins) {
    if (!all_ && !adaptive.uncertain()) return false;
    weight_ = draw_.weight(rate(adaptive.last_difference()));
    if (draw_.unit() != unit_) {
        unit_ = draw_.unit();
        closely_ = closely;
        wrong_bins_ = wrong_bins;
    }
    if (!(weight_ > 0.0)) return false;
    samples_.clear();
    sums_.clear();
    for (const Strip& strip : adaptive.check_strips())
        quads_.add(*strip.slice, *strip.low, *strip.high);
    quads_.end_beam();
    return true;
}

void BeamCheck::hand_over(BeamErrors& errors) const {
    errors.add_check(sums_, weight_);
}

double likely_error(const BeamErrors& errors) {
    return error_of_fine_patches + errors.edge_bins() + error_if_checked * errors.of_checked() +
           error_if_not * errors.of_others();
}

double estimated_error(const BeamErrors& errors) {
    const double bins = deviation_of_bins * errors.root_of_squares();
    const double draw = error_if_not * errors.others_deviation();
    return likely_error(errors) + deviations * std::sqrt(bins * bins + draw * draw);
}

bool few_bins_decide(const BeamErrors& errors, double goal) {
    return goal * errors.occupied_bins() < bins_of_one_cause;
}

double estimated_error_of_few_bins(const BeamErrors& errors) {
    const double run = errors.root_of_runs();
    const double distance = errors.of_checked();
    const double runs = run > 0.0 ? std::max(distance * distance / (run * run), 1.0) : 1.0;
    const double bins = student(runs) * deviation_of_bins * run;
    const double draw = deviations * error_if_not * errors.others_deviation();
    return likely_error(errors) + std::sqrt(bins * bins + draw * draw);
}

double enough_for_few_bins(double goal, int pass) {
    return pass == 1 ? enough_at_first * goal : goal;
}

}  // namespace sonarsim
