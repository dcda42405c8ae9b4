#include "simulate/visibility/make_engine.h"

#include <algorithm>
#include <utility>

#include "simulate/visibility/octree/tree.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/slices/slices_engine.h"
#include "simulate/visibility/strips/strips_engine.h"

namespace sonarsim {

namespace {

/// With more triangles than this `auto` takes rays, whose time hardly depends on their number.
constexpr std::size_t slices_triangles_max = std::size_t{1} << 19;

/// Factor on the density of rays over many triangles if a bin holds a mean.
constexpr int density_over_many_triangles = 4;

/// Rays for the views that need them; slices, or dense rays over many triangles, for others.
class AutoEngine final : public VisibilityEngine {
  public:
    AutoEngine(const Scene& scene, const Caster& caster, std::vector<View> by_rays)
        : others_(make_others(scene, caster)),
          rays_(make_rays_engine(scene, caster)),
          by_rays_(std::move(by_rays)) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const bool by_rays = std::ranges::find(by_rays_, view) != by_rays_.end();
        return (by_rays ? rays_ : others_)->visible_surface(view, T_world_sensor);
    }

    void intersect(const Pose& T_world_sensor, std::span<const Ray> rays,
                   std::span<Intersection> intersections) const override {
        rays_->intersect(T_world_sensor, rays, intersections);
    }

  private:
    static std::unique_ptr<VisibilityEngine> make_others(const Scene& scene, const Caster& caster) {
        const std::size_t triangles = scene.triangles.size();
        if (triangles <= slices_triangles_max) return make_slices_engine(scene, caster);
        return make_rays_engine(scene, caster,
                                triangles > many_triangles ? density_over_many_triangles : 1);
    }

    std::unique_ptr<VisibilityEngine> others_, rays_;
    std::vector<View> by_rays_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree) return make_octree_engine(scene, settings.octree);
    const Caster caster = settings.caster ? *settings.caster : Caster(scene);
    if (settings.type == EngineKind::slices) return make_slices_engine(scene, caster);
    if (settings.type == EngineKind::strips) return make_strips_engine(scene, caster);
    if (settings.type == EngineKind::automatic && !scene.sound_profile && scene.bodies.empty() &&
        scene.copies.empty())
        return std::make_unique<AutoEngine>(scene, caster, settings.by_rays);
    return make_rays_engine(scene, caster);
}

std::string unsupported(const EngineSettings& settings, const Scene& scene) {
    const bool is_octree = settings.type == EngineKind::octree;
    const bool is_strips = settings.type == EngineKind::strips;
    const std::string engine = is_octree   ? "engine: octree"
                               : is_strips ? "engine: strips"
                                           : "engine: slices";
    const std::string instead = "; use engine: auto or engine: rays";
    if (is_octree || is_strips || settings.type == EngineKind::slices) {
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

std::string slices_warning(const EngineSettings& settings, bool multipath, bool energies_add) {
    if (settings.type != EngineKind::slices) return "";
    // With a box under a water surface, rays found 669 echoes over both, slices none.
    if (multipath) {
        return "engine: slices misses most multipath: reflections start at the middle of each "
               "patch of surface, and a patch of the slices may span the whole elevation of a "
               "beam; use engine: auto or engine: rays";
    }
    if (energies_add) {
        return "engine: slices makes speckled ground up to 1.1 dB too bright with model: "
               "calibrated: its patches overlap; use engine: auto or engine: rays";
    }
    return "";
}

}  // namespace sonarsim
