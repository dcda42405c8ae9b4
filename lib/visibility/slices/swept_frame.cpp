#include "visibility/slices/swept_frame.h"

#include <algorithm>

#include "visibility/slices/beam_cutter.h"
#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

// With a fixed number of slices, gaps are split only for narrow components.
constexpr SliceErrorLimit unlimited{.share = 1e9, .carry_over = 0.0};

// Ratio of an image's error to the square root of its slice error: where slices are to be added.
// The estimate of the error does not depend on it. The square root follows from where slices are
// added: where neighbours differ most, so the rest of the error does not fall in proportion.
constexpr double error_per_difference = 0.16;

/// Error of an image without errors of visibility: patches of surface become boxes in range.
double error_of_shapes(double relative_l1) {
    return 0.002 + 0.003 * std::clamp(relative_l1 / 0.03, 0.1, 1.0);
}

/// Limit of the slice error for an error goal, less `edge_bins`, the expected error of edge bins.
/// More slices do not meet goals near the error of shapes: the limit is at least an eighth of the
/// goal.
SliceErrorLimit slice_error_limit(double relative_l1, double edge_bins) {
    // A coarse goal is used except for a tenth, the uncertainty of the estimate: beams share their
    // allowance, and edge bins are subtracted. At 1 % errors are up to 1.15 times the estimate, so
    // every beam has to meet the goal by itself.
    const bool coarse = is_coarse(relative_l1);
    const double goal = coarse ? 0.9 * relative_l1 - edge_bins : relative_l1;
    const double left = std::max(goal - error_of_shapes(relative_l1), 0.0);
    return {.share = std::max(left * left / (error_per_difference * error_per_difference),
                              0.125 * relative_l1),
            .carry_over = coarse ? 0.25 : 0.0};
}

}  // namespace

bool frames_share_beams(const View& view) {
    return view.beams <= 2;
}

SweptFrame::SweptFrame(const SlicesPing& ping, const SliceFrame& frame, Samples& samples,
                       BeamErrors& errors, CheckedBeams& checked)
    : frame_(frame),
      checked_(checked),
      scan_(ping.mesh, ping.scene, frame, ping.pose, patch_limits(ping.view).range_max_m),
      adaptive_(ping.view, ping.scene.materials, scan_),
      check_(ping.view, scan_, ping.scene.materials, checked.samples.items()) {
    const PatchLimits limits = patch_limits(ping.view);
    QuadSampler sampler(scan_, ping.scene.materials, limits, errors.sums(), samples.items);
    StripQuads quads(scan_, limits, sampler);
    BeamCutter cutter(frame, quads, errors, samples);
    const auto most = [&] {
        return ping.any_error ? unlimited
                              : slice_error_limit(ping.view.relative_l1, errors.edge_bins());
    };
    while (adaptive_.scan_next(most())) {
        for (const SliceResult* result : adaptive_.slices())
            cutter.add(*result);
        if (adaptive_.uncertain() || frames_share_beams(ping.view)) adaptive_.keep(kept_);
    }
}

SweptFrame::Check SweptFrame::check(std::size_t uncertain) {
    adaptive_.restore(kept_, uncertain);
    BeamSums& sums = check_.look_at(adaptive_);
    const auto per_beam = static_cast<std::uint32_t>(frame_.slices_per_beam);
    const std::uint32_t beam_of_frame = kept_.beams[uncertain].first_gap / per_beam;
    const int beam = frame_.first_beam + static_cast<int>(beam_of_frame);
    checked_.beams.push_back(beam);
    checked_.samples.end_row();
    return {beam, sums};
}

}  // namespace sonarsim
