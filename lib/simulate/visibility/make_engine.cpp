#include "simulate/visibility/make_engine.h"

#include <optional>

#include "simulate/visibility/octree/tree.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/strips/strips_engine.h"

namespace sonarsim {

namespace {

/// In scenes of more triangles `auto` takes rays, as their time hardly depends on them.
constexpr std::size_t strips_triangles_max = std::size_t{1} << 19;

/// Factor on the density of rays over many triangles if a bin holds a mean.
constexpr int density_over_many_triangles = 4;

/// Strips, or rays in scenes of many triangles. Multipath starts where rays meet the surface.
class StripsOrRays final : public VisibilityEngine {
  public:
    StripsOrRays(const Scene& scene, const Caster& caster, bool by_strips)
        : StripsOrRays(scene, caster) {
        if (by_strips) strips_.emplace(scene, caster);
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        if (strips_) return strips_->visible_surface(view, T_world_sensor);
        const bool dense = dense_rays_ && !view.energies_add;
        return (dense ? dense_rays_ : rays_)->visible_surface(view, T_world_sensor);
    }

    const VisibilityEngine& by_rays() const override { return *rays_; }

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        const Caster moved = caster().moved(T_world_body);
        std::unique_ptr<StripsOrRays> out(new StripsOrRays(scene(), moved));
        if (strips_) out->strips_.emplace(*strips_, moved);
        return out;
    }

  private:
    StripsOrRays(const Scene& scene, const Caster& caster)
        : VisibilityEngine(scene, caster), rays_(make_rays_engine(scene, caster)) {
        if (scene.triangles.size() > many_triangles)
            dense_rays_ = make_rays_engine(scene, caster, density_over_many_triangles);
    }

    std::unique_ptr<VisibilityEngine> rays_, dense_rays_;
    std::optional<StripsEngine> strips_;
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree) return make_octree_engine(scene, settings.octree);
    const Caster caster = settings.caster ? *settings.caster : Caster(scene);
    if (settings.type == EngineKind::rays || scene.sound_profile)
        return make_rays_engine(scene, caster);
    const bool by_strips =
        settings.type == EngineKind::strips || caster.placed_triangles() <= strips_triangles_max;
    return std::make_unique<StripsOrRays>(scene, caster, by_strips);
}

std::string unsupported(const EngineSettings& settings, const Scene& scene) {
    const bool is_octree = settings.type == EngineKind::octree;
    const std::string engine = is_octree ? "engine: octree" : "engine: strips";
    const std::string instead = "; use engine: auto or engine: rays";
    if (is_octree || settings.type == EngineKind::strips) {
        if (scene.sound_profile)
            return engine + " needs straight paths of sound, and water.profile bends them" +
                   instead;
    }
    if (!is_octree) return "";
    if (!scene.bodies.empty()) return engine + " does not support moving objects" + instead;
    if (!scene.copies.empty())
        return engine + " does not support copies of shared meshes" + instead;
    return too_small_leaves((scene.bounds_max - scene.bounds_min).maxCoeff(),
                            settings.octree.leaf_m);
}

std::string unsupported(const EngineSettings& settings, const View& view) {
    if (settings.type != EngineKind::octree || !view.energies_add) return "";
    return "engine: octree has votes in place of areas, and model: calibrated needs areas; use "
           "engine: auto";
}

}  // namespace sonarsim
