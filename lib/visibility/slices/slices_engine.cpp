#include "visibility/slices/slices_engine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <utility>

#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/slices/beam_check.h"
#include "visibility/slices/beam_errors.h"
#include "visibility/slices/check_beams.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/edge_rays.h"
#include "visibility/slices/patch_limits.h"
#include "visibility/slices/point_image.h"
#include "visibility/slices/sampled_image.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/swept_frame.h"

namespace sonarsim {

namespace {

/// Initial number of slices per beam for an error goal.
int slices_for(double relative_l1) {
    return is_coarse(relative_l1) ? 1 : relative_l1 >= 0.005 ? 2 : 4;
}

// The most passes over a ping, and the share of the goal at which a further pass aims. Chosen for
// cost, on the lifeboat and the drawn lattices 1000 to 1109.
constexpr int most_passes = 3;
constexpr double aimed_share = 0.8;

// The same if few bins decide, and the factor on the slices of a further pass. Fixed numbers of 1,
// 4, 16 and 64 slices per beam leave median errors of 3.2, 1.0, 0.4 and 0.2 % in 48 drawn lattices
// of one or two beams (13000 to 13149). Slices that are added where neighbours differ converge less
// reliably.
constexpr int most_passes_of_few = 4;
constexpr int times_the_slices = 4;

class SlicesEngine final : public VisibilityEngine {
  public:
    SlicesEngine(const Scene& scene, const Caster& caster, const SlicesOptions& options)
        : scene_(&scene),
          options_(options),
          caster_(caster),
          mesh_(std::make_shared<const ClusterMesh>(make_clusters(scene))) {}

    SlicesEngine(const SlicesEngine& other, bool image_by_points) : SlicesEngine(other) {
        options_.image_by_points = image_by_points;
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        const double goal = view.relative_l1;
        View finer = view;
        bool draws = draws_beams(view);
        int least_slices = slices_for(goal);
        std::optional<PointImage> points;
        for (int pass = 1;; ++pass) {
            Pass result = run_pass(finer, draws, goal, pose, least_slices);
            bool last = is_last(result, view, pass);
            if (last && result.few_bins && options_.per_beam == 0) {
                settle_with_rays(view, pose, pass, result, points);
                last = is_last(result, view, pass);
            }
            if (last) return std::move(result.samples);
            if (result.few_bins) least_slices *= times_the_slices;
            draws = false;
            finer.relative_l1 *=
                std::clamp(aimed_share * goal / result.error_if_checked, 0.25, 0.67);
        }
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

  private:
    struct Pass {
        Samples samples;
        double error_if_checked;  ///< the estimated error if all beams were checked
        double edge_bins;         ///< part of edge bins in the estimated error
        bool few_bins;            ///< few bins decide
    };

    /// True if the ping needs no further pass, or gets none.
    bool is_last(const Pass& result, const View& view, int pass) const {
        const double goal = view.relative_l1;
        const double enough = result.few_bins ? pass_limit_of_few_bins(goal, pass) : goal;
        // More slices do not help against edge bins.
        const bool hopeless = result.edge_bins > goal;
        return result.samples.estimated_l1 <= enough || hopeless || options_.per_beam > 0 ||
               pass >= (result.few_bins ? most_passes_of_few : most_passes);
    }

    /// Lets rays decide about edge bins, so that the estimate needs no allowance for them. Then
    /// compares the image with one by points, which is made once.
    void settle_with_rays(const View& view, const LocalPose& pose, int pass, Pass& result,
                          std::optional<PointImage>& points) const {
        SampledImage before = image_of(*scene_, view, result.samples);
        const std::vector<EdgeBin> edges =
            settle_edge_bins(caster_, view, pose, before, result.samples);
        const bool asked =
            std::ranges::any_of(edges, [](EdgeBin edge) { return edge != EdgeBin::not_tested; });
        const SampledImage settled =
            asked ? image_of(*scene_, view, result.samples) : std::move(before);
        // Ends that could not be moved may be right in the second or third pass; a later one does
        // not help.
        const double dark = share_in_dark_bins(settled, edges);
        const double allowed = std::exchange(result.edge_bins, pass > 2 ? dark : 0.0);
        double& estimate = result.samples.estimated_l1;
        estimate += dark - allowed;
        if (!options_.image_by_points || estimate > view.relative_l1) return;
        if (!points) points.emplace(*scene_, *mesh_, caster_, view, pose);
        estimate = std::max(estimate, points->error_of(settled, edges));
    }

    /// One pass over a ping, as fine as `view` requires, with at least `least_slices` per beam;
    /// `goal` is that of the mission.
    Pass run_pass(const View& view, bool draws, double goal, const LocalPose& pose,
                  int least_slices) const {
        const bool fixed = options_.per_beam > 0;
        const int per_beam =
            fixed ? options_.per_beam : std::max(slices_for(view.relative_l1), least_slices);
        const SlicesPing ping{*mesh_, *scene_, view, pose, fixed};
        const std::vector<SliceFrame> frames = slice_frames(view, per_beam);
        SlicesImage image(view);
        if (draws) {
            sweep_and_draw(ping, frames, goal, image);
        } else {
            sweep_and_check(ping, frames, image);
        }
        replace_checked(scene_->maps != nullptr, image);
        const BeamErrors& errors = image.errors;
        const bool few_bins = few_bins_decide(errors, goal);
        image.samples.estimated_l1 =
            few_bins ? estimated_error_of_few_bins(errors) : estimated_error(errors);
        const double error_if_checked =
            errors.of_others() > 0.0 ? likely_error_if_checked(errors) : image.samples.estimated_l1;
        return {std::move(image.samples), error_if_checked, errors.edge_bins(), few_bins};
    }

    const Scene* scene_;
    SlicesOptions options_;
    Caster caster_;
    std::shared_ptr<const ClusterMesh> mesh_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene,
                                                     const SlicesOptions& options) {
    return make_slices_engine(scene, Caster(scene), options);
}

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene, const Caster& caster,
                                                     const SlicesOptions& options) {
    return std::make_unique<SlicesEngine>(scene, caster, options);
}

std::unique_ptr<VisibilityEngine> without_points(const VisibilityEngine& slices) {
    return std::make_unique<SlicesEngine>(dynamic_cast<const SlicesEngine&>(slices), false);
}

}  // namespace sonarsim
