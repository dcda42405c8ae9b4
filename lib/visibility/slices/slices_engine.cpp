#include "visibility/slices/slices_engine.h"

#include <algorithm>
#include <cmath>

#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/envelope.h"
#include "visibility/slices/extra_slices.h"
#include "visibility/slices/merge_spans.h"
#include "visibility/slices/scan.h"
#include "visibility/slices/setup.h"
#include "visibility/slices/slice_walk.h"
#include "visibility/slices/span_samples.h"

namespace sonarsim {

namespace {

/// Slices to a beam for an error goal.
int slices_for(double relative_l1) {
    return std::clamp(static_cast<int>(std::ceil(0.04 / relative_l1)), 1, 32);
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
        Scratch scratch;
        for (SliceFrame& frame : slice_frames(view, per_beam))
            see_frame(view, pose, frame, scratch, samples);
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

  private:
    /// Memory that one frame after the other reuses.
    struct Scratch {
        SetupScratch setup;
        SliceScene scene;
        SliceWalk walk;
        EnvelopeScratch envelope;
        std::vector<VisibleSpan> spans;
        std::vector<bool> met;  ///< pieces that a regular slice meets
    };

    void see_frame(const View& view, const LocalPose& pose, SliceFrame& frame, Scratch& scratch,
                   Samples& samples) const {
        const PieceLimits limits = piece_limits(view);
        SliceScene& scene = scratch.scene;
        set_up_slices(mesh_, scene_->vertices, frame, pose, limits.range_max_m, scratch.setup,
                      scene);
        if (add_extra_slices(scene, frame)) {
            scratch.met = scene.met;
            set_up_slices(mesh_, scene_->vertices, frame, pose, limits.range_max_m, scratch.setup,
                          scene);
        }
        samples.dropped += scene.dropped;
        scratch.walk.start(scene, frame);
        SpanSampler sampler(mesh_, frame, scene, limits, samples.items);
        for (int s = 0; s < static_cast<int>(frame.slices.size()); ++s) {
            const Slice& slice = frame.slices[s];
            std::vector<VisibleSpan>& spans = scratch.spans;
            visible_spans(scratch.walk.step(s), scene, slice, scratch.envelope, spans);
            if (slice.extra) {
                std::erase_if(spans, [&](const VisibleSpan& span) {
                    const SeenFacet& seen = scene.facets[scene.trapezoids[span.trapezoid].seen];
                    return scratch.met[mesh_.facets[seen.facet].piece];
                });
            }
            merge_coplanar_spans(mesh_, scene, spans);
            for (int k = 0; k < slice.strips; ++k) {
                sampler.add(slice, slice.strip[k], spans);
                samples.beam_begin[slice.strip[k].beam + 1] =
                    static_cast<std::uint32_t>(samples.items.size());
            }
        }
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
