#include "simulate/visibility/rays/rays_engine.h"

#include <algorithm>
#include <utility>

#include "simulate/visibility/rays/bent_rays.h"
#include "simulate/visibility/rays/ray_columns.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

// The number of rays, before gaps are split, that are cast together if the rays are dense: 40 MB.
constexpr int max_rays_together = 1 << 16;

// Columns of a side-scan where energies add, per column that resolves surface; fitted.
constexpr int columns_along_track = 4;

// A bent ray is cast as chords that are off by this share of a bin at most.
constexpr double sag_by_bin = 0.25;
constexpr double sag_of_sight_lines_m = 0.01;
constexpr int max_bent_surfaces = 8;  // chosen: each costs a cast of all chords

class RaysEngine final : public VisibilityEngine {
  public:
    RaysEngine(const Scene& scene, Caster caster, int density, int along)
        : VisibilityEngine(scene, std::move(caster)), density_(density), along_(along) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const Sampling sampling = denser_sampling(view);
        const LocalPose pose = local_pose(T_world_sensor, scene().origin);
        Samples samples;
        const int together = beams_together(view, sampling);
        for (int begin = 0; begin < view.beams; begin += together) {
            const BeamRange beams{begin, std::min(begin + together, view.beams)};
            const RayColumns columns = cast_ray_columns(caster(), view, pose, sampling, beams,
                                                        water(sag_by_bin * view.bin_m()));
            add_column_samples(view, sampling, columns, beams, samples);
        }
        return samples;
    }

    void pass_surfaces(const Pose& T_world_sensor, std::span<const Ray> rays, float reach_m,
                       const UseSurfaces& use) const override {
        if (!scene().sound_profile)
            return VisibilityEngine::pass_surfaces(T_world_sensor, rays, reach_m, use);
        pass_bent(T_world_sensor, rays, reach_m, max_bent_surfaces, use);
    }

    std::vector<bool> visible(const Pose& T_world_sensor,
                              std::span<const SightPoint> points) const override {
        if (!scene().sound_profile) return VisibilityEngine::visible(T_world_sensor, points);
        float reach_m = 0.0F;
        std::vector<Ray> rays;
        for (const SightPoint& point : points) {
            rays.push_back({Eigen::Vector3f::Zero(), point.position.normalized()});
            reach_m = std::max(reach_m, point.position.norm());
        }
        std::vector<bool> out;
        pass_bent(T_world_sensor, rays, reach_m, 1,
                  [&](std::size_t k, std::span<const Intersection> met) {
                      out.push_back(met.empty() || !(met[0].distance_m < points[k].position.norm() -
                                                                             points[k].slack_m -
                                                                             met[0].rounding_m));
                  });
        return out;
    }

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        return std::make_unique<RaysEngine>(scene(), caster().moved(T_world_body), density_,
                                            along_);
    }

  private:
    Sampling denser_sampling(View view) const {
        view.relative_l1 /= density_;
        Sampling sampling = sampling_for(view);
        sampling.columns *= density_;
        if (view.energies_add && view.shape == ViewShape::fan) sampling.rays *= along_;
        // The beam of a side-scan receives most from its middle, so a column must lie there.
        if (view.energies_add && view.shape == ViewShape::port_starboard)
            sampling.columns = columns_along_track * sampling.columns | 1;
        return sampling;
    }

    /// The number of beams cast together: all, or of dense rays as many as bounded memory allows.
    int beams_together(const View& view, const Sampling& sampling) const {
        if (density_ == 1 && along_ == 1) return std::max(view.beams, 1);
        return std::max(max_rays_together / (sampling.columns * sampling.rays), 1);
    }

    void pass_bent(const Pose& T_world_sensor, std::span<const Ray> rays, float reach_m,
                   int max_surfaces, const UseSurfaces& use) const {
        pass_bent_rays(caster(), water(sag_of_sight_lines_m),
                       local_pose(T_world_sensor, scene().origin), rays, reach_m, max_surfaces,
                       use);
    }

    BentWater water(double sag_m) const {
        return {scene().sound_profile.get(), scene().origin.z(), sag_m};
    }

    int density_, along_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene) {
    return make_rays_engine(scene, Caster(scene));
}

std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, const Caster& caster,
                                                   int density, int along) {
    return std::make_unique<RaysEngine>(scene, caster, density, along);
}

}  // namespace sonarsim
