#include "visibility/slices/swept_frame.h"

#include <algorithm>

#include "visibility/slices/beam_cutter.h"
#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

// With a fixed number of slices, gaps are split only for narrow components.
constexpr SliceErrorLimit unlimited{.share = 1e9, .carry_over = 0.0};

// Ratio of an image's error to the square root of its slice error. It decides how many slices are
// added; the estimate of the error does not depend on it. Slices are added where neighbours differ
// most, so the rest of the error falls more slowly than the slice error, hence the square root.
// Chosen for cost: a ping of the lifeboat takes 1.04 of the time with 0.12, by more checks, and
// 1.07 with 0.20, by more slices.
constexpr double error_per_difference = 0.16;

/// Error of an image without errors of visibility: patches of surface become boxes in range.
double error_of_shapes(double relative_l1) {
    return 0.002 + 0.003 * std::clamp(relative_l1 / 0.03, 0.1, 1.0);
}

/// Limit of the slice error for an error goal, less `edge_bins`, the expected error of edge bins.
/// More slices do not meet goals near the error of shapes: the limit is at least an eighth of the
/// goal.
SliceErrorLimit slice_error_limit(double relative_l1, double edge_bins) {
    // At a coarse goal beams share their allowance, nine tenths of the goal less the edge bins; the
    // last tenth is for the uncertainty of the estimate. At 1 % errors are up to 1.15 times the
    // estimate, so every beam has to meet the goal by itself.
    const bool coarse = is_coarse(relative_l1);
    const double goal = coarse ? 0.9 * relative_l1 - edge_bins : relative_l1;
    const double left = std::max(goal - error_of_shapes(relative_l1), 0.0);
    return {.share = std::max(left * left / (error_per_difference * error_per_difference),
                              0.125 * relative_l1),
            .carry_over = coarse ? 0.25 : 0.0};
}

/// Scans the slices of a frame, and adds its beams to the image. `after_beam` is called when the
/// slices of a beam are known, but not yet the borders of the last of them.
template <typename AfterBeam>
void sweep(const SlicesPing& ping, FrameScan& scan, AdaptiveSlices& adaptive, SlicesImage& image,
           AfterBeam after_beam) {
    const PatchLimits limits = patch_limits(ping.view);
    BeamErrors& errors = image.errors;
    QuadSampler sampler(scan, ping.scene.materials, limits, errors.sums(), image.samples.items);
    StripQuads quads(scan, limits, sampler);
    BeamCutter cutter(scan.frame(), quads, errors, image.samples);
    const auto most = [&] {
        return ping.any_error
                   ? unlimited
                   : slice_error_limit(ping.view.relative_l1, errors.edge_bins_before_checks());
    };
    while (adaptive.scan_next(most())) {
        for (const SliceResult* result : adaptive.slices())
            cutter.add(*result);
        after_beam();
    }
}

/// The number of a beam in its view.
int beam_at(const SliceFrame& frame, std::uint32_t gap) {
    return frame.first_beam + static_cast<int>(gap) / frame.slices_per_beam;
}

FrameScan scan_of(const SlicesPing& ping, const SliceFrame& frame) {
    return {ping.mesh, ping.scene, frame, ping.pose, patch_limits(ping.view).range_max_m};
}

/// Notes that the last samples are those of the check of a beam.
void end_check(int beam, SlicesImage& image) {
    image.checked.push_back(beam);
    image.checked_samples.end_row();
}

/// A beam ends with the first slice of the next one, so its check waits for that slice.
void sweep_and_check(const SlicesPing& ping, const SliceFrame& frame, SlicesImage& image) {
    FrameScan scan = scan_of(ping, frame);
    AdaptiveSlices adaptive(ping.view, ping.scene.materials, scan);
    BeamCheck check(ping.view, scan, ping.scene.materials, image.checked_samples.items());
    BeamSums* waiting = nullptr;
    const auto add_waiting = [&] {
        if (waiting != nullptr) image.errors.check(image.checked.back(), *waiting, 1.0);
        waiting = nullptr;
    };
    sweep(ping, scan, adaptive, image, [&] {
        add_waiting();
        if (!adaptive.uncertain()) return;
        waiting = &check.check_beam(adaptive);
        end_check(beam_at(frame, adaptive.first_gap()), image);
    });
    image.errors.finish();
    add_waiting();
    image.samples.dropped += scan.scene().dropped;
}

/// The check of a beam is the sum of the checks of all its frames, also of those without errors.
void sweep_and_check_shared(const SlicesPing& ping, std::span<const SliceFrame> frames,
                            SlicesImage& image) {
    std::vector<BeamSums> sums(ping.view.beams, BeamSums(ping.view));
    for (const SliceFrame& frame : frames) {
        FrameScan scan = scan_of(ping, frame);
        AdaptiveSlices adaptive(ping.view, ping.scene.materials, scan);
        BeamCheck check(ping.view, scan, ping.scene.materials, image.checked_samples.items());
        sweep(ping, scan, adaptive, image, [&] {
            const int beam = beam_at(frame, adaptive.first_gap());
            sums[beam].add(check.check_beam(adaptive));
            end_check(beam, image);
        });
        image.samples.dropped += scan.scene().dropped;
    }
    image.errors.finish();
    for (int beam = 0; beam < std::ssize(sums); ++beam)
        image.errors.check(beam, sums[beam], 1.0);
}

}  // namespace

SlicesImage::SlicesImage(const View& view) : errors(view) {
    samples.beam_begin.assign(view.beams + 1, 0);
}

bool frames_share_beams(const View& view) {
    return view.beams <= 2;
}

void sweep_and_check(const SlicesPing& ping, std::span<const SliceFrame> frames,
                     SlicesImage& image) {
    if (frames_share_beams(ping.view)) {
        sweep_and_check_shared(ping, frames, image);
        return;
    }
    for (const SliceFrame& frame : frames)
        sweep_and_check(ping, frame, image);
}

SweptFrame::SweptFrame(const SlicesPing& ping, const SliceFrame& frame, SlicesImage& image)
    : frame_(frame),
      image_(image),
      scan_(scan_of(ping, frame)),
      adaptive_(ping.view, ping.scene.materials, scan_),
      check_(ping.view, scan_, ping.scene.materials, image.checked_samples.items()) {
    sweep(ping, scan_, adaptive_, image, [&] {
        if (adaptive_.uncertain()) adaptive_.keep(kept_);
    });
}

void SweptFrame::check(std::size_t uncertain, double weight) {
    adaptive_.restore(kept_, uncertain);
    BeamSums& sums = check_.check_beam(adaptive_);
    const int beam = beam_at(frame_, kept_.beams[uncertain].first_gap);
    end_check(beam, image_);
    image_.errors.check(beam, sums, weight);
}

}  // namespace sonarsim
