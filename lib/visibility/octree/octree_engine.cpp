#include "visibility/octree/octree_engine.h"

#include <cmath>

#include "core/text.h"
#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/octree/leaf_samples.h"
#include "visibility/octree/literal.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

namespace {

class LazyOctreeEngine final : public OctreeEngine {
  public:
    LazyOctreeEngine(const Scene& scene, const OctreeOptions& options)
        : scene_(&scene), options_(options), caster_(scene), tree_(scene, caster_, options) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const Pose T_local_sensor{T_world_sensor.rotation,
                                  T_world_sensor.translation - scene_->origin};
        const ViewVolume volume(view, T_local_sensor);
        const LeafSize leaf_size(view, options_.leaf_m);
        return options_.literal ? literal_samples(tree_, *scene_, view, volume, leaf_size)
                                : leaf_samples(tree_, *scene_, view, volume, leaf_size);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::string> warnings() const override {
        const double needed_mb = std::ceil(static_cast<double>(tree_.statistics().ping_bytes) /
                                           static_cast<double>(1U << 20U));
        if (needed_mb <= static_cast<double>(options_.memory_mb)) return {};
        return {"octree.memory_mb: " + std::to_string(options_.memory_mb) +
                " is too little: one ping needs " + number_text(needed_mb) +
                " MB, so what it grows is dropped before the next ping can use it; set it to " +
                number_text(needed_mb) + " or more"};
    }

    OctreeStatistics statistics() const override { return tree_.statistics(); }

  private:
    const Scene* scene_;
    OctreeOptions options_;
    Caster caster_;
    mutable Octree tree_;  ///< grows with the pings, under its own locks
};

}  // namespace

std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options) {
    return std::make_unique<LazyOctreeEngine>(scene, options);
}

}  // namespace sonarsim
