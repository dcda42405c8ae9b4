#include "simulate/visibility/make_engine.h"

#include <algorithm>
#include <utility>

#include "simulate/visibility/octree/tree.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/strips/strips_engine.h"

namespace sonarsim {

namespace {

/// In scenes of more triangles `auto` takes rays for means, as their time hardly depends on them.
constexpr std::size_t strips_triangles_max = std::size_t{1} << 19;

/// In scenes of more triangles it takes rays for fans of energies: each piece of the strips costs
/// an echo. A side or a cone has few beams and few pieces.
constexpr std::size_t strips_of_energies_max = std::size_t{1} << 15;

/// Factor on the density of rays over many triangles if a bin holds a mean.
constexpr int density_over_many_triangles = 4;

/// Strips, or rays for the views that need them or suit them better.
class AutoEngine final : public VisibilityEngine {
  public:
    AutoEngine(const Scene& scene, const Caster& caster, std::vector<View> by_rays)
        : triangles_(scene.triangles.size()),
          strips_(scene, caster),
          rays_(make_rays_engine(scene, caster)),
          by_rays_(std::move(by_rays)) {
        if (triangles_ > many_triangles)
            dense_rays_ = make_rays_engine(scene, caster, density_over_many_triangles);
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        if (std::ranges::find(by_rays_, view) != by_rays_.end())
            return rays_->visible_surface(view, T_world_sensor);
        if (suits_strips(view, triangles_)) return strips_.visible_surface(view, T_world_sensor);
        const bool dense = dense_rays_ && !view.energies_add;
        return (dense ? dense_rays_ : rays_)->visible_surface(view, T_world_sensor);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        rays_->intersect(T_world_sensor, rays, intersections);
    }

  private:
    std::size_t triangles_;
    StripsEngine strips_;
    std::unique_ptr<VisibilityEngine> rays_, dense_rays_;
    std::vector<View> by_rays_;
};

}  // namespace

bool suits_strips(const View& view, std::size_t triangles) {
    if (!view.energies_add) return triangles <= strips_triangles_max;
    return view.shape != ViewShape::fan || triangles <= strips_of_energies_max;
}

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree) return make_octree_engine(scene, settings.octree);
    const Caster caster = settings.caster ? *settings.caster : Caster(scene);
    if (settings.type == EngineKind::strips) return std::make_unique<StripsEngine>(scene, caster);
    if (settings.type == EngineKind::automatic && !scene.sound_profile && scene.bodies.empty() &&
        scene.copies.empty())
        return std::make_unique<AutoEngine>(scene, caster, settings.by_rays);
    return make_rays_engine(scene, caster);
}

std::string unsupported(const EngineSettings& settings, const Scene& scene) {
    const bool is_octree = settings.type == EngineKind::octree;
    const std::string engine = is_octree ? "engine: octree" : "engine: strips";
    const std::string instead = "; use engine: auto or engine: rays";
    if (is_octree || settings.type == EngineKind::strips) {
        if (scene.sound_profile)
            return engine + " needs straight paths of sound, and water.profile bends them" +
                   instead;
        if (!scene.bodies.empty()) return engine + " does not support moving objects" + instead;
        if (!scene.copies.empty())
            return engine + " does not support copies of shared meshes" + instead;
    }
    if (!is_octree) return "";
    return too_small_leaves((scene.bounds_max - scene.bounds_min).maxCoeff(),
                            settings.octree.leaf_m);
}

std::string unsupported(const EngineSettings& settings, const View& view) {
    if (settings.type != EngineKind::octree || !view.energies_add) return "";
    return "engine: octree has votes in place of areas, and model: calibrated needs areas; use "
           "engine: auto";
}

std::string strips_warning(const EngineSettings& settings, bool multipath) {
    if (settings.type != EngineKind::strips || !multipath) return "";
    return "engine: strips misses most multipath: reflections start at the middle of each patch of "
           "surface, and a patch of the strips may span the whole elevation of a beam; use engine: "
           "auto or engine: rays";
}

}  // namespace sonarsim
