#include "visibility/slices/slices_engine.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/slices/adaptive_slices.h"
#include "visibility/slices/beam_check.h"
#include "visibility/slices/beam_cutter.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/edge_rays.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/point_image.h"
#include "visibility/slices/quad_samples.h"
#include "visibility/slices/sampled_image.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/strip_quads.h"

namespace sonarsim {

namespace {

// With a fixed number of slices, gaps are split only for narrow components.
constexpr SliceErrorLimit unlimited{.share = 1e9, .carry_over = 0.0};

/// Initial number of slices per beam for an error goal.
int slices_for(double relative_l1) {
    return is_coarse(relative_l1) ? 1 : relative_l1 >= 0.005 ? 2 : 4;
}

// Ratio of an image's error to the square root of its slice error: where slices are to be added.
// The estimate of the error does not depend on it. The square root follows from where slices are
// added: where neighbours differ most, so the rest of the error does not fall in proportion.
constexpr double error_per_difference = 0.16;

// The passes over a ping at most, one more if the first draws beams, and the share of the goal at
// which a further pass aims: chosen for cost, on the lifeboat and the drawn lattices 1000 to 1109.
constexpr int most_passes = 3;
constexpr double aimed_share = 0.8;

// The same if few bins decide, and how many times the slices a further pass has. Fixed numbers of
// 1, 4, 16 and 64 slices per beam leave median errors of 3.2, 1.0, 0.4 and 0.2 % in 48 drawn
// lattices of one or two beams (13000 to 13149). Slices that are added where neighbours differ do
// not converge so surely.
constexpr int most_passes_of_few = 4;
constexpr int times_the_slices = 4;

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

class SlicesEngine final : public VisibilityEngine {
  public:
    SlicesEngine(const Scene& scene, const Caster& caster, const SlicesOptions& options,
                 bool coverage)
        : scene_(&scene),
          options_(options),
          caster_(caster),
          coverage_(scene, coverage),
          mesh_(std::make_shared<const ClusterMesh>(make_clusters(scene))) {}

    SlicesEngine(const SlicesEngine& other, bool image_by_points) : SlicesEngine(other) {
        options_.image_by_points = image_by_points;
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        const double goal = view.relative_l1;
        View finer = view;
        BeamsToCheck which = beams_to_check(view);
        int least_slices = slices_for(goal);
        std::optional<PointImage> points;
        for (int pass = 1;; ++pass) {
            Pass seen = see(finer, which, goal, pose, least_slices);
            bool last = is_last(seen, view, pass);
            if (last && seen.few_bins && options_.per_beam == 0) {
                ask_rays(view, pose, pass, seen, points);
                last = is_last(seen, view, pass);
            }
            if (last) return std::move(seen.samples);
            if (seen.few_bins) least_slices *= times_the_slices;
            if (seen.few_bins || which == BeamsToCheck::all) {
                const double error = seen.samples.estimated_l1;
                finer.relative_l1 *= std::clamp(aimed_share * goal / error, 0.25, 0.67);
            }
            which = more_beams(which, seen, goal);
        }
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return coverage_.bins(view, T_world_sensor);
    }

  private:
    struct Pass {
        Samples samples;
        double likely_error;
        double edge_bins;  ///< their part of the estimated error
        bool few_bins;     ///< few bins decide
    };

    /// The beams that the next pass checks: half of them if that may suffice. Checked beams have
    /// less error, so half of them lower it to (1 + 1.41) / 2 / 1.41 of that without checks.
    static BeamsToCheck more_beams(BeamsToCheck before, const Pass& seen, double goal) {
        const bool half_suffices = 0.85 * seen.likely_error <= aimed_share * goal;
        return before == BeamsToCheck::drawn && !seen.few_bins && half_suffices ? BeamsToCheck::half
                                                                                : BeamsToCheck::all;
    }

    /// True if the ping needs no further pass, or gets none.
    bool is_last(const Pass& seen, const View& view, int pass) const {
        const double goal = view.relative_l1;
        const int most = most_passes + (beams_to_check(view) == BeamsToCheck::all ? 0 : 1);
        const double enough = seen.few_bins ? enough_for_few_bins(goal, pass) : goal;
        // More slices do not help against edge bins.
        const bool hopeless = seen.edge_bins > goal;
        return seen.samples.estimated_l1 <= enough || hopeless || options_.per_beam > 0 ||
               pass >= (seen.few_bins ? most_passes_of_few : most);
    }

    /// Lets rays decide about edge bins, so that the estimate needs no allowance for them. Then
    /// compares the image with one by points, which is made once.
    void ask_rays(const View& view, const LocalPose& pose, int pass, Pass& seen,
                  std::optional<PointImage>& points) const {
        SampledImage before = image_of(*scene_, view, seen.samples);
        const std::vector<EdgeBin> edges =
            settle_edge_bins(caster_, view, pose, before, seen.samples);
        const bool asked =
            std::ranges::any_of(edges, [](EdgeBin edge) { return edge != EdgeBin::not_asked; });
        const SampledImage settled =
            asked ? image_of(*scene_, view, seen.samples) : std::move(before);
        // Ends that cannot be moved may be better in the next pass, not in all.
        const double dark = share_in_dark_bins(settled, edges);
        const double allowed = std::exchange(seen.edge_bins, pass > 2 ? dark : 0.0);
        double& estimate = seen.samples.estimated_l1;
        estimate += dark - allowed;
        if (!options_.image_by_points || estimate > view.relative_l1) return;
        if (!points) points.emplace(*scene_, *mesh_, caster_, view, pose);
        estimate = std::max(estimate, points->error_of(settled, edges));
    }

    /// One pass over a ping, as fine as `view` asks, with at least so many slices per beam; `goal`
    /// is that of the mission.
    Pass see(const View& view, BeamsToCheck which, double goal, const LocalPose& pose,
             int least_slices) const {
        const int per_beam = options_.per_beam > 0
                                 ? options_.per_beam
                                 : std::max(slices_for(view.relative_l1), least_slices);
        Samples samples;
        samples.beam_begin.assign(view.beams + 1, 0);
        BeamErrors errors(view);
        for (const SliceFrame& frame : slice_frames(view, per_beam))
            see_frame(view, which, goal, pose, frame, samples, errors);
        errors.finish();
        const bool few_bins = few_bins_decide(errors, goal);
        samples.estimated_l1 =
            few_bins ? estimated_error_of_few_bins(errors) : estimated_error(errors);
        return {std::move(samples), likely_error(errors), errors.edge_bins(), few_bins};
    }

    void see_frame(const View& view, BeamsToCheck which, double goal, const LocalPose& pose,
                   const SliceFrame& frame, Samples& samples, BeamErrors& errors) const {
        const PatchLimits limits = patch_limits(view);
        FrameScan scan(*mesh_, *scene_, frame, pose, limits.range_max_m);
        AdaptiveSlices adaptive(view, scene_->materials, scan);
        QuadSampler sampler(scan, scene_->materials, limits, errors.sums(), samples.items);
        StripQuads quads(scan, limits, sampler);
        BeamCutter cutter(frame, quads, errors, samples, scene_->maps != nullptr);
        BeamCheck check(view, which, scan, scene_->materials);
        const auto most = [&] {
            return options_.per_beam > 0 ? unlimited
                                         : slice_error_limit(view.relative_l1, errors.edge_bins());
        };
        while (adaptive.scan_next(most())) {
            // More draws decide if the estimate and its limit are on different sides of the goal.
            const bool closely = likely_error(errors) <= goal && estimated_error(errors) > goal;
            const double wrong_bins = goal * errors.bins_per_beam() * view.beams;
            const bool drawn = check.look_at(adaptive, closely, wrong_bins);
            for (const SliceResult* result : adaptive.slices())
                cutter.add(*result);
            if (!drawn) continue;
            check.hand_over(errors);
            cutter.replace(check.samples());
        }
        samples.dropped += scan.scene().dropped;
    }

    const Scene* scene_;
    SlicesOptions options_;
    Caster caster_;
    SceneCoverage coverage_;
    std::shared_ptr<const ClusterMesh> mesh_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene,
                                                     const SlicesOptions& options, bool coverage) {
    return make_slices_engine(scene, Caster(scene), options, coverage);
}

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene, const Caster& caster,
                                                     const SlicesOptions& options, bool coverage) {
    return std::make_unique<SlicesEngine>(scene, caster, options, coverage);
}

std::unique_ptr<VisibilityEngine> without_points(const VisibilityEngine& slices) {
    return std::make_unique<SlicesEngine>(dynamic_cast<const SlicesEngine&>(slices), false);
}

}  // namespace sonarsim
