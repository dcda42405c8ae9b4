#include "visibility/rays/rays_engine.h"

#include <memory>
#include <utility>
#include <vector>

#include "visibility/caster.h"
#include "visibility/coverage.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/rays/column_samples.h"
#include "visibility/rays/ray_columns.h"

namespace sonarsim {

namespace {

class RaysEngine final : public VisibilityEngine {
  public:
    RaysEngine(const Eigen::Vector3d& origin, Caster caster, SceneCoverage coverage,
               std::span<const Pose> T_world_body)
        : origin_(origin),
          caster_(std::move(caster)),
          coverage_(std::move(coverage)),
          T_world_body_(T_world_body.begin(), T_world_body.end()) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const Sampling sampling = sampling_for(view);
        const LocalPose pose = local_pose(T_world_sensor, origin_);
        const RayColumns columns = cast_ray_columns(caster_, view, pose, sampling);
        return column_samples(view, sampling, columns);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        intersect_rays(caster_, origin_, T_world_sensor, rays, intersections);
    }

    std::vector<std::uint8_t> covered_bins(const View& view,
                                           const Pose& T_world_sensor) const override {
        return coverage_.bins(view, T_world_sensor, T_world_body_);
    }

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        std::vector<Pose> T_local_body(T_world_body.begin(), T_world_body.end());
        for (Pose& pose : T_local_body)
            pose.translation -= origin_;
        return std::make_unique<RaysEngine>(origin_, caster_.moved(T_local_body), coverage_,
                                            T_world_body);
    }

    std::span<const Pose> body_poses() const override { return T_world_body_; }

  private:
    Eigen::Vector3d origin_;
    Caster caster_;
    SceneCoverage coverage_;
    std::vector<Pose> T_world_body_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, bool coverage) {
    return std::make_unique<RaysEngine>(scene.origin, Caster(scene), SceneCoverage(scene, coverage),
                                        std::span<const Pose>());
}

}  // namespace sonarsim
