#include "visibility/slices/beam_check.h"

#include <algorithm>
#include <cmath>

#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

// The error of a beam over its distance D from its check, for a checked beam, which gets the image
// of its check, and for another beam; see BeamCheck.
constexpr double error_if_checked = 1.0;
constexpr double error_if_not = 1.414;

// Standard deviation of |x| - |y| for two independent normal variables, in units of their own:
// sqrt(2 (1 - 2 / pi)).
constexpr double deviation_of_bins = 0.853;

// Standard deviations of a one-sided limit with a confidence of 95 %.
constexpr double deviations = 1.645;

// A bar or an edge that slices misplace changes several neighbouring bins: one cause makes fewer
// bins than this wrong. Chosen.
constexpr double bins_of_one_cause = 8.0;

// The first pass over a view of few bins suffices if its estimate is below this share of the goal;
// see BeamCheck.
constexpr double enough_at_first = 0.25;

// Error of the check's own patches: boxes in range for curved surface. It is error_of_shapes() in
// swept_frame.cpp at its finest, which was fitted to the tank and the lifeboat
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

/// The patches of the check are as small as a third of the error goal requires, and at least as
/// small as a goal of 1 % does.
PatchLimits fine_limits(View view) {
    view.relative_l1 = std::min(view.relative_l1 / 3.0, 0.01);
    return patch_limits(view);
}

}  // namespace

BeamCheck::BeamCheck(const View& view, const FrameScan& scan, std::span<const Material> materials,
                     std::vector<Sample>& samples)
    : sums_(view),
      sampler_(scan, materials, fine_limits(view), sums_, samples),
      quads_(scan, fine_limits(view), sampler_) {}

BeamSums& BeamCheck::check_beam(AdaptiveSlices& adaptive) {
    sums_.clear();
    for (const Strip& strip : adaptive.check_strips())
        quads_.add(*strip.slice, *strip.low, *strip.high);
    quads_.end_beam();
    return sums_;
}

double likely_error(const BeamErrors& errors) {
    return error_of_fine_patches + errors.edge_bins() + error_if_checked * errors.of_checked() +
           error_if_not * errors.of_others();
}

double likely_error_if_checked(const BeamErrors& errors) {
    return error_of_fine_patches + errors.edge_bins() +
           error_if_checked * (errors.of_checked() + errors.of_others());
}

double estimated_error(const BeamErrors& errors) {
    const double bins = deviations * deviation_of_bins * errors.root_of_squares();
    // Variances from differences of successive draws have two thirds of the degrees of freedom
    // that the draws have (von Neumann 1941: their variance is 3/2 of the usual one).
    const double degrees = std::max((errors.draws() - 1) / 1.5, 1.0);
    const double draw = student(degrees) * error_if_not * errors.others_deviation();
    return likely_error(errors) + std::sqrt(bins * bins + draw * draw);
}

bool few_bins_decide(const BeamErrors& errors, double goal) {
    return goal * errors.occupied_bins() < bins_of_one_cause;
}

double share_with_one_cause(const BeamErrors& errors, double goal) {
    return bins_of_one_cause / std::max(goal * errors.occupied_bins(), bins_of_one_cause);
}

double estimated_error_of_few_bins(const BeamErrors& errors) {
    const double run = errors.root_of_runs();
    const double distance = errors.of_checked();
    const double runs = run > 0.0 ? std::max(distance * distance / (run * run), 1.0) : 1.0;
    return likely_error(errors) + student(runs) * deviation_of_bins * run;
}

double pass_limit_of_few_bins(double goal, int pass) {
    return pass == 1 ? enough_at_first * goal : goal;
}

}  // namespace sonarsim
