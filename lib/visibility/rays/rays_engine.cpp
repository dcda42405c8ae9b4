#include "visibility/rays/rays_engine.h"

#include <utility>
#include <vector>

#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/rays/column_samples.h"
#include "visibility/rays/ray_columns.h"

namespace sonarsim {

namespace {

class RaysEngine final : public VisibilityEngine {
  public:
    RaysEngine(const Eigen::Vector3d& origin, Caster caster)
        : origin_(origin), caster_(std::move(caster)) {}

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

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        std::vector<Pose> T_local_body(T_world_body.begin(), T_world_body.end());
        for (Pose& pose : T_local_body)
            pose.translation -= origin_;
        return std::make_unique<RaysEngine>(origin_, caster_.moved(T_local_body));
    }

  private:
    Eigen::Vector3d origin_;
    Caster caster_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene) {
    return std::make_unique<RaysEngine>(scene.origin, Caster(scene));
}

}  // namespace sonarsim
