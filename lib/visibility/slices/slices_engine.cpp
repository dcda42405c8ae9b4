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

// With a number of slices that is given, gaps are split for narrow pieces alone.
constexpr double unlimited = 1e9;

/// Slices to a beam that an error goal begins with.
int slices_for(double relative_l1) {
    return relative_l1 >= 0.02 ? 1 : relative_l1 >= 0.005 ? 2 : 4;
}

// How far the slices of an image disagree says how far the image is off. Fitted to the errors of a
// lifeboat of 7,920 triangles and a tank, eight poses each at goals of 10, 3, 1 and 0.3 %, within a
// factor of 1.6. The square root: where slices are added they are added where they disagree most,
// and the rest of the error does not fall along with it.
constexpr double error_of_disagreement = 0.16;

/// Error of an image whose slices see everything: pieces of surface become boxes in range.
double error_of_shapes(double relative_l1) {
    return 0.002 + 0.002 * std::clamp(relative_l1 / 0.03, 0.1, 1.0);
}

double estimated_error(double relative_l1, double disagreement) {
    return error_of_shapes(relative_l1) + error_of_disagreement * std::sqrt(disagreement);
}

/// What slices may disagree by for an error goal. Goals near the error of shapes are not met by
/// more slices: they end at an eighth of the goal.
double disagreement_for(double relative_l1) {
    const double left = std::max(relative_l1 - error_of_shapes(relative_l1), 0.0);
    return std::max(left * left / (error_of_disagreement * error_of_disagreement),
                    0.125 * relative_l1);
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
        const double most = options_.per_beam > 0 ? unlimited : disagreement_for(view.relative_l1);
        Disagreement sum;
        for (const SliceFrame& frame : slice_frames(view, per_beam))
            see_frame(view, pose, frame, most, samples, sum);
        samples.estimated_l1 = estimated_error(view.relative_l1, sum.share());
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

  private:
    void see_frame(const View& view, const LocalPose& pose, const SliceFrame& frame, double most,
                   Samples& samples, Disagreement& sum) const {
        const PieceLimits limits = piece_limits(view);
        FrameScan scan(mesh_, *scene_, frame, pose, limits.range_max_m);
        BeamSlices beam(view, scene_->materials, scan);
        SpanSampler sampler(scan, limits, samples.items);
        for (std::uint32_t gap = 0; gap < frame.gaps.size();) {
            const std::uint32_t next = beam.see(gap, most);
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
        sum.apart += beam.sum().apart;
        sum.signal += beam.sum().signal;
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
