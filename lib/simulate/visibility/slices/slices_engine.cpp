#include "simulate/visibility/slices/slices_engine.h"

#include "simulate/visibility/caster.h"
#include "simulate/visibility/intersect.h"
#include "simulate/visibility/local_pose.h"
#include "simulate/visibility/slices/adaptive_slices.h"
#include "simulate/visibility/clusters.h"
#include "simulate/visibility/slices/frame_scan.h"
#include "simulate/visibility/slices/patch_limits.h"
#include "simulate/visibility/slices/slice_frames.h"
#include "simulate/visibility/slices/strip_quads.h"

namespace sonarsim {

namespace {

class SlicesEngine final : public VisibilityEngine {
  public:
    SlicesEngine(const Scene& scene, const Caster& caster, int per_beam)
        : scene_(&scene), per_beam_(per_beam), caster_(caster), mesh_(make_clusters(scene)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        const SliceDensity density = slice_density(view);
        const int per_beam = per_beam_ > 0 ? per_beam_ : density.per_beam;
        const double share = per_beam_ > 0 ? no_limit : density.difference;
        Samples samples;
        samples.beam_begin.assign(view.beams + 1, 0);
        for (const SliceFrame& frame : slice_frames(view, per_beam))
            sweep(view, frame, pose, share, samples);
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

  private:
    static constexpr double no_limit = 1e9;

    /// Scans the slices of a frame, and adds the samples of its beams.
    void sweep(const View& view, const SliceFrame& frame, const LocalPose& pose, double share,
               Samples& samples) const {
        const PatchLimits limits = patch_limits(view);
        FrameScan scan(mesh_, *scene_, frame, pose, limits.range_max_m);
        AdaptiveSlices adaptive(view, scene_->materials, scan);
        StripQuads quads(scan, limits, samples);
        while (adaptive.scan_next(share)) {
            for (const SliceResult* result : adaptive.slices())
                quads.add(*result);
        }
        samples.dropped += scan.scene().dropped;
    }

    const Scene* scene_;
    int per_beam_;
    Caster caster_;
    ClusterMesh mesh_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene, const Caster& caster,
                                                     int per_beam) {
    return std::make_unique<SlicesEngine>(scene, caster, per_beam);
}

}  // namespace sonarsim
