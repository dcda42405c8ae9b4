#include "visibility/octree/octree_engine.h"

#include <cmath>
#include <string>
#include <vector>

#include "core/text.h"
#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/image_change.h"
#include "visibility/intersect.h"
#include "visibility/octree/goal_check.h"
#include "visibility/octree/leaf_samples.h"
#include "visibility/octree/literal.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

namespace {

/// The relative L1 of an image, as a share of its change when leaves are twice as large. Measured
/// on five scenes with leaves from 1 to 8 cm, as means over eight poses: 0.39 to 0.76, the least on
/// a sphere; for single pings 0.25 to 1.56.
constexpr double error_per_change = 0.7;

class LazyOctreeEngine final : public OctreeEngine {
  public:
    LazyOctreeEngine(const Scene& scene, const OctreeOptions& options)
        : scene_(&scene),
          options_(options),
          caster_(scene),
          surface_(scene),
          tree_(scene, caster_, options) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const Pose T_local_sensor{T_world_sensor.rotation,
                                  T_world_sensor.translation - scene_->origin};
        const ViewVolume volume(view, T_local_sensor);
        const LeafSize leaf_size(view, options_.leaf_m);
        if (options_.literal) return literal_samples(tree_, *scene_, view, volume, leaf_size);
        Samples samples = leaf_samples(tree_, caster_, *scene_, view, volume, leaf_size);
        if (goal_check_.wants(view, T_world_sensor)) {
            const Samples coarse =
                leaf_samples(tree_, caster_, *scene_, view, volume, leaf_size.twice());
            goal_check_.add(view, T_world_sensor,
                            error_per_change * image_change(mean_echoes(*scene_, view, coarse),
                                                            mean_echoes(*scene_, view, samples)));
        }
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return sonarsim::covered_bins(surface_, view, T_world_sensor);
    }

    std::vector<std::string> warnings() const override {
        std::vector<std::string> all = goal_check_.warnings(options_.leaf_m);
        const double needed_mb = std::ceil(static_cast<double>(tree_.statistics().ping_bytes) /
                                           static_cast<double>(1U << 20U));
        if (needed_mb <= static_cast<double>(options_.memory_mb)) return all;
        all.push_back(
            "octree.memory_mb: " + std::to_string(options_.memory_mb) +
            " is too little: one ping needs " + number_text(needed_mb) +
            " MB, so its tiles are dropped before the next ping can use them; set it to " +
            number_text(needed_mb) + " or more");
        return all;
    }

    OctreeStatistics statistics() const override { return tree_.statistics(); }

  private:
    const Scene* scene_;
    OctreeOptions options_;
    Caster caster_;
    TriangleRuns surface_;
    mutable Octree tree_;           ///< grows with the pings; has its own locks
    mutable GoalCheck goal_check_;  ///< has its own lock
};

}  // namespace

std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options) {
    return std::make_unique<LazyOctreeEngine>(scene, options);
}

}  // namespace sonarsim
