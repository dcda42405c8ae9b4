#include "visibility/octree/octree_engine.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "visibility/caster.h"
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

/// A prepared ping, which does not change.
struct ReadyPing {
    Sight sight;
    PreparedView leaves;
    std::optional<PreparedView> coarse;  ///< leaves twice as large, if the error is estimated
    std::shared_ptr<double> error;       ///< the place for the estimate
};

bool same_pose(const Pose& a, const Pose& b) {
    return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

/// The parts that an engine shares with the engines of its prepared().
struct OctreeParts {
    OctreeParts(const Scene& of_scene, const OctreeOptions& with)
        : scene(of_scene), options(with), caster(scene), tree(scene, caster, options) {}

    const Scene& scene;
    OctreeOptions options;
    Caster caster;
    std::mutex preparing;  ///< guards changes of the tree and of the goal check; pings only read
    Octree tree;
    GoalCheck goal_check;
};

class OctreeEngineWithPings final : public OctreeEngine {
  public:
    OctreeEngineWithPings(std::shared_ptr<OctreeParts> parts, std::vector<ReadyPing> pings)
        : parts_(std::move(parts)), pings_(std::move(pings)) {}

    /// Takes no locks for the pings that are ready.
    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const auto ping = std::ranges::find_if(pings_, [&](const ReadyPing& one) {
            return one.sight.view == view && same_pose(one.sight.T_world_sensor, T_world_sensor);
        });
        return see(ping != pings_.end() ? *ping : ready({view, T_world_sensor}));
    }

    std::unique_ptr<VisibilityEngine> prepared(std::span<const Sight> sights) const override {
        std::vector<ReadyPing> pings;
        for (const Sight& sight : sights)
            pings.push_back(ready(sight));
        return std::make_unique<OctreeEngineWithPings>(parts_, std::move(pings));
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(parts_->caster, parts_->scene.origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::string> warnings() const override {
        const std::scoped_lock alone(parts_->preparing);
        std::vector<std::string> all = parts_->goal_check.warnings(parts_->options.leaf_m);
        const double needed_mb =
            std::ceil(static_cast<double>(parts_->tree.statistics().ping_bytes) /
                      static_cast<double>(1U << 20U));
        const std::size_t memory_mb = parts_->options.memory_mb;
        if (needed_mb <= static_cast<double>(memory_mb)) return all;
        all.push_back(
            "octree.memory_mb: " + std::to_string(memory_mb) + " is too little: one ping needs " +
            number_text(needed_mb) +
            " MB, so its tiles are dropped before the next ping can use them; set it to " +
            number_text(needed_mb) + " or more");
        return all;
    }

    OctreeStatistics statistics() const override {
        const std::scoped_lock alone(parts_->preparing);
        return parts_->tree.statistics();
    }

  private:
    ReadyPing ready(const Sight& sight) const {
        auto& [scene, options, caster, preparing, tree, goal_check] = *parts_;
        const Pose T_local_sensor{sight.T_world_sensor.rotation,
                                  sight.T_world_sensor.translation - scene.origin};
        const LeafSize leaf_size(sight.view, options.leaf_m);
        const std::scoped_lock alone(preparing);
        ReadyPing ping{sight, tree.prepare(sight.view, T_local_sensor, leaf_size), {}, {}};
        if (options.literal) return ping;
        ping.error = goal_check.place_for(sight.view, sight.T_world_sensor);
        if (ping.error) ping.coarse = tree.prepare(sight.view, T_local_sensor, leaf_size.twice());
        return ping;
    }

    Samples see(const ReadyPing& ping) const {
        const Scene& scene = parts_->scene;
        const Octree& tree = parts_->tree;
        if (parts_->options.literal) return literal_samples(tree, scene, ping.leaves);
        Samples samples = leaf_samples(tree, parts_->caster, scene, ping.leaves);
        if (ping.coarse) {
            const View& view = ping.sight.view;
            const Samples coarse = leaf_samples(tree, parts_->caster, scene, *ping.coarse);
            *ping.error = error_per_change * image_change(mean_echoes(scene, view, coarse),
                                                          mean_echoes(scene, view, samples));
        }
        return samples;
    }

    std::shared_ptr<OctreeParts> parts_;
    std::vector<ReadyPing> pings_;
};

}  // namespace

std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options) {
    return std::make_unique<OctreeEngineWithPings>(std::make_shared<OctreeParts>(scene, options),
                                                   std::vector<ReadyPing>{});
}

}  // namespace sonarsim
