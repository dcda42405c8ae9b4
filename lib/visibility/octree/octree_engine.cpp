#include "visibility/octree/octree_engine.h"

#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/image_change.h"
#include "visibility/intersect.h"
#include "visibility/octree/goal_check.h"
#include "visibility/octree/leaf_samples.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

namespace {

/// The relative L1 of an image, as a share of its change when leaves are twice as large. Measured
/// on five scenes with leaves from 1 to 8 cm, as means over eight poses: 0.39 to 0.76, the least on
/// a sphere; for single pings 0.25 to 1.56.
constexpr double error_per_change = 0.7;

/// A ping that is ready: nothing of it changes any more.
struct ReadyPing {
    Sight sight;
    PreparedView leaves;
    std::optional<PreparedView> coarse;  ///< leaves twice as large, if the error is estimated
    std::shared_ptr<double> error;       ///< the place for the estimate
};

bool same_pose(const Pose& a, const Pose& b) {
    return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

class GrowingOctreeEngine final : public OctreeEngine {
  public:
    GrowingOctreeEngine(const Scene& scene, const OctreeOptions& options, bool coverage)
        : scene_(&scene),
          options_(options),
          caster_(scene),
          coverage_(scene, coverage),
          tree_(scene, caster_, options) {}

    ReadyPing ready(const Sight& sight) const {
        const Pose T_local_sensor{sight.T_world_sensor.rotation,
                                  sight.T_world_sensor.translation - scene_->origin};
        const LeafSize leaf_size(sight.view, options_.leaf_m);
        const std::scoped_lock alone(preparing_);
        ReadyPing ping{sight, tree_.prepare(sight.view, T_local_sensor, leaf_size), {}, {}};
        if (options_.literal) return ping;
        ping.error = goal_check_.place_for(sight.view, sight.T_world_sensor);
        if (ping.error) ping.coarse = tree_.prepare(sight.view, T_local_sensor, leaf_size.twice());
        return ping;
    }

    Samples visible_surface(const ReadyPing& ping) const {
        if (options_.literal) return literal_samples(tree_, *scene_, ping.leaves);
        Samples samples = leaf_samples(tree_, caster_, *scene_, ping.leaves);
        if (ping.coarse) {
            const View& view = ping.sight.view;
            const Samples coarse = leaf_samples(tree_, caster_, *scene_, *ping.coarse);
            *ping.error = error_per_change * image_change(mean_echoes(*scene_, view, coarse),
                                                          mean_echoes(*scene_, view, samples));
        }
        return samples;
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        return visible_surface(ready({view, T_world_sensor}));
    }

    std::unique_ptr<VisibilityEngine> prepared(std::span<const Sight> sights) const override;

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return coverage_.bins(view, T_world_sensor);
    }

    std::vector<std::string> warnings() const override {
        const std::scoped_lock alone(preparing_);
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

    OctreeStatistics statistics() const override {
        const std::scoped_lock alone(preparing_);
        return tree_.statistics();
    }

  private:
    const Scene* scene_;
    OctreeOptions options_;
    Caster caster_;
    SceneCoverage coverage_;
    mutable std::mutex preparing_;  ///< guards changes of the members below; pings only read
    mutable Octree tree_;
    mutable GoalCheck goal_check_;
};

/// The engine with some pings ready. It takes no locks.
class PreparedOctreeEngine final : public VisibilityEngine {
  public:
    PreparedOctreeEngine(const GrowingOctreeEngine& engine, std::vector<ReadyPing> pings)
        : engine_(engine), pings_(std::move(pings)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        for (const ReadyPing& ping : pings_) {
            if (ping.sight.view == view && same_pose(ping.sight.T_world_sensor, T_world_sensor))
                return engine_.visible_surface(ping);
        }
        return engine_.visible_surface(view, T_world_sensor);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        engine_.intersect(T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return engine_.covered_bins(view, T_world_sensor);
    }

  private:
    const GrowingOctreeEngine& engine_;
    std::vector<ReadyPing> pings_;
};

std::unique_ptr<VisibilityEngine> GrowingOctreeEngine::prepared(
    std::span<const Sight> sights) const {
    std::vector<ReadyPing> pings;
    for (const Sight& sight : sights)
        pings.push_back(ready(sight));
    return std::make_unique<PreparedOctreeEngine>(*this, std::move(pings));
}

}  // namespace

std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options,
                                                 bool coverage) {
    return std::make_unique<GrowingOctreeEngine>(scene, options, coverage);
}

}  // namespace sonarsim
