#include "visibility/octree/octree_engine.h"

#include <algorithm>
#include <cmath>

#include "visibility/caster.h"
#include "visibility/octree/literal.h"
#include "visibility/octree/look.h"
#include "visibility/octree/tree.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim {

namespace {

class LazyOctree final : public OctreeSurface {
  public:
    LazyOctree(const Scene& scene, const OctreeOptions& options)
        : scene_(&scene), options_(options), caster_(scene), tree_(scene, caster_, options) {}

    void look(const View& view, const Pose& T_world_sensor, Samples& samples) const override {
        const Pose T_local_sensor{T_world_sensor.rotation,
                                  T_world_sensor.translation - scene_->origin};
        const Field field(view, T_local_sensor, options_.leaf_m);
        samples.dropped = 0;
        if (options_.literal) {
            look_literally(tree_, *scene_, view, field, samples);
        } else {
            look_at_leaves(tree_, *scene_, view, field, samples);
        }
    }

    void hit(const Pose& T_world_sensor, std::span<const Ray> rays,
             std::span<Hit> hits) const override {
        trace_rays(caster_, scene_->origin, T_world_sensor, rays, hits);
    }

    OctreeStatistics statistics() const override { return tree_.statistics(); }

  private:
    const Scene* scene_;
    OctreeOptions options_;
    Caster caster_;
    mutable Octree tree_;  ///< grows as it is looked at, under its own locks
};

}  // namespace

std::unique_ptr<OctreeSurface> make_octree_surface(const Scene& scene,
                                                   const OctreeOptions& options) {
    return std::make_unique<LazyOctree>(scene, options);
}

}  // namespace sonarsim
