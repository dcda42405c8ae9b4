#include "surface/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "surface/caster.h"
#include "surface/chain_samples.h"
#include "surface/chains.h"

namespace sonarsim {

namespace {

class RaysSurface final : public Surface {
  public:
    explicit RaysSurface(const Scene& scene) : origin_(scene.origin), caster_(scene) {}

    void look(const View& view, const Pose& T_world_sensor, Samples& samples) const override {
        const Sampling sampling = sampling_for(view);
        const Chains chains = cast_chains(caster_, view, local(T_world_sensor), sampling);
        chain_samples(caster_, view, sampling, chains, samples);
    }

    void hit(const Pose& T_world_sensor, std::span<const Ray> rays,
             std::span<Hit> hits) const override {
        const LocalPose pose = local(T_world_sensor);
        std::vector<Eigen::Vector3f> origins(rays.size());
        std::vector<Eigen::Vector3f> directions(rays.size());
        std::vector<std::uint32_t> facets(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            origins[i] = pose.rotation * rays[i].origin + pose.position;
            directions[i] = pose.rotation * rays[i].direction;
        }
        caster_.cast(origins, directions, facets);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (facets[i] == Caster::nothing) {
                hits[i] = {std::numeric_limits<float>::infinity(), Eigen::Vector3f::Zero(), 0, 0};
                continue;
            }
            const Facet& facet = caster_.facet(facets[i]);
            const float along = facet.normal.dot(directions[i]);
            const float distance = facet.normal.dot(facet.vertex - origins[i]) / along;
            const Eigen::Vector3f normal =
                pose.rotation.transpose() * (along > 0.0F ? -facet.normal : facet.normal);
            hits[i] = {distance, normal, facet.material, facet.instance};
        }
    }

  private:
    LocalPose local(const Pose& T_world_sensor) const {
        return {T_world_sensor.rotation.toRotationMatrix().cast<float>(),
                (T_world_sensor.translation - origin_).cast<float>()};
    }

    Eigen::Vector3d origin_;
    Caster caster_;
};

}  // namespace

std::unique_ptr<Surface> make_rays_surface(const Scene& scene) {
    return std::make_unique<RaysSurface>(scene);
}

}  // namespace sonarsim
