#include "visibility/rays/rays_engine.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/rays/column_samples.h"
#include "visibility/rays/ray_columns.h"
#include "visibility/rays/set_disagreement.h"
#include "visibility/rays/surface_probes.h"

namespace sonarsim {

namespace {

// Probes of the estimate, as a share of the rays of a ping: they take about a hundredth of its
// time.
constexpr std::size_t rays_per_probe = 128;
constexpr std::size_t fewest_probes = 100;

class RaysEngine final : public VisibilityEngine {
  public:
    RaysEngine(const Scene& scene, Caster caster, SceneCoverage coverage,
               std::span<const Pose> T_world_body)
        : scene_(&scene),
          caster_(std::move(caster)),
          coverage_(std::move(coverage)),
          T_world_body_(T_world_body.begin(), T_world_body.end()) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const Sampling sampling = sampling_for(view);
        const LocalPose pose = local_pose(T_world_sensor, scene_->origin);
        const RayColumns columns = cast_ray_columns(caster_, view, pose, sampling);
        SetComparison comparison(view, scene_->materials);
        Samples samples = column_samples(view, sampling, columns, comparison);
        const SetDisagreement& image = comparison.result();
        const std::size_t probes = std::max(columns.rays.size() / rays_per_probe, fewest_probes);
        samples.estimated_l1 =
            image.error() + share_of_dark_bins(*scene_, caster_, view, pose, image, probes);
        return samples;
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, scene_->origin, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return coverage_.bins(view, T_world_sensor, T_world_body_);
    }

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        std::vector<Pose> T_local_body(T_world_body.begin(), T_world_body.end());
        for (Pose& pose : T_local_body)
            pose.translation -= scene_->origin;
        return std::make_unique<RaysEngine>(*scene_, caster_.moved(T_local_body), coverage_,
                                            T_world_body);
    }

    std::span<const Pose> body_poses() const override { return T_world_body_; }

  private:
    const Scene* scene_;
    Caster caster_;
    SceneCoverage coverage_;
    std::vector<Pose> T_world_body_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, bool coverage) {
    return make_rays_engine(scene, Caster(scene), coverage);
}

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, const Caster& caster,
                                                   bool coverage) {
    return std::make_unique<RaysEngine>(scene, caster, SceneCoverage(scene, coverage),
                                        std::span<const Pose>());
}

}  // namespace sonarsim
