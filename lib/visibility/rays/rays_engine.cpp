#include "visibility/rays/rays_engine.h"

#include "visibility/caster.h"
#include "visibility/intersect.h"
#include "visibility/local_pose.h"
#include "visibility/rays/column_samples.h"
#include "visibility/rays/ray_columns.h"

namespace sonarsim {

namespace {

class RaysEngine final : public VisibilityEngine {
  public:
    explicit RaysEngine(const Scene& scene) : origin_(scene.origin), caster_(scene) {}

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

  private:
    Eigen::Vector3d origin_;
    Caster caster_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene) {
    return std::make_unique<RaysEngine>(scene);
}

}  // namespace sonarsim
