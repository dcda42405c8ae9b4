#include "visibility/slices/slices_engine.h"

#include <algorithm>
#include <cmath>

#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/slices/beam_slices.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/frame_scan.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/span_samples.h"

namespace sonarsim {

namespace {

// With a number of slices that is given, gaps are split for hidden pieces alone.
constexpr double no_goal = 1e9;

/// Slices to a beam that an error goal begins with: one where few beams have to be refined.
int slices_for(double relative_l1) {
    return relative_l1 >= 0.02 ? 1 : relative_l1 >= 0.005 ? 2 : 4;
}

/// Error of an image whose slices see everything: pieces of surface become boxes in range.
double shape_error(double relative_l1) {
    return 0.002 + 0.002 * std::clamp(relative_l1 / 0.03, 0.1, 1.0);
}

class SlicesEngine final : public VisibilityEngine {
  public:
    SlicesEngine(const Scene& scene, const SlicesOptions& options)
        : scene_(&scene), options_(options), caster_(scene), mesh_(make_clusters(scene)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const int per_beam =
            options_.per_beam > 0 ? options_.per_beam : slices_for(view.relative_l1);
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        Samples samples;
        samples.beam_begin.assign(view.beams + 1, 0);
        const double goal = options_.per_beam > 0
                                ? no_goal
                                : std::max(view.relative_l1 - shape_error(view.relative_l1),
                                           0.5 * view.relative_l1);
        ImageSums sums;
        for (const SliceFrame& frame : slice_frames(view, per_beam))
            see_frame(view, pose, frame, goal, samples, sums);
        samples.estimated_l1 = shape_error(view.relative_l1) + sums.share();
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

  private:
    void see_frame(const View& view, const LocalPose& pose, const SliceFrame& frame, double goal,
                   Samples& samples, ImageSums& sums) const {
        const PieceLimits limits = piece_limits(view);
        FrameScan scan(mesh_, *scene_, frame, pose, limits.range_max_m);
        BeamSlices beam(view, scene_->materials, scan);
        SpanSampler sampler(scan, limits, samples.items);
        for (std::uint32_t gap = 0; gap < frame.gaps.size();) {
            const std::uint32_t next = beam.see(gap, goal);
            const std::span<const SeenSlice* const> slices = beam.slices();
            float from = frame.gaps[gap].u_low;
            for (std::size_t i = 0; i < slices.size(); ++i) {
                const float to = i + 1 < slices.size()
                                     ? 0.5F * (slices[i]->slice.u + slices[i + 1]->slice.u)
                                     : frame.gaps[next - 1].u_high;
                sampler.add(slices[i]->slice, from, to, slices[i]->spans);
                from = to;
            }
            samples.beam_begin[frame.gaps[gap].beam + 1] =
                static_cast<std::uint32_t>(samples.items.size());
            gap = next;
        }
        samples.dropped += scan.scene().dropped;
        sums.error += beam.sums().error;
        sums.signal += beam.sums().signal;
    }

    const Scene* scene_;
    SlicesOptions options_;
    Caster caster_;
    ClusterMesh mesh_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene,
                                                     const SlicesOptions& options) {
    return std::make_unique<SlicesEngine>(scene, options);
}

}  // namespace sonarsim
