#include "simulate/visibility/make_engine.h"

#include <atomic>

#include "simulate/visibility/octree/tree.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/strips/strips.h"

namespace sonarsim {

namespace {

/// In scenes of more triangles `auto` takes rays, as their time hardly depends on them.
constexpr std::size_t strips_triangles_max = std::size_t{1} << 19;

// Factors on the rays over many triangles, where bins hold means, and on the starts of multipath.
constexpr int density_over_many_triangles = 4;
constexpr int starts_along_column = 4;

/// Strips, or rays in scenes of many triangles. Multipath starts where rays meet the surface.
class StripsOrRays final : public VisibilityEngine {
  public:
    StripsOrRays(const Scene& scene, const Caster& caster, bool by_strips)
        : StripsOrRays(scene, caster) {
        if (by_strips) strips_.reset(new Strips{SceneClusters(scene)});
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        if (strips_) {
            Samples out =
                strips_surface(strips_->clusters.in_view(view, T_world_sensor, body_poses()), view,
                               strips_->last_samples.load(std::memory_order_relaxed));
            strips_->last_samples.store(out.items.size(), std::memory_order_relaxed);
            return out;
        }
        const bool dense = dense_rays_ && !view.energies_add;
        return (dense ? dense_rays_ : rays_)->visible_surface(view, T_world_sensor);
    }

    const VisibilityEngine& by_rays() const override { return *starts_; }

    std::unique_ptr<VisibilityEngine> at(std::span<const Pose> T_world_body) const override {
        std::unique_ptr<StripsOrRays> out(new StripsOrRays(scene(), caster().moved(T_world_body)));
        out->strips_ = strips_;
        return out;
    }

  private:
    StripsOrRays(const Scene& scene, const Caster& caster)
        : VisibilityEngine(scene, caster),
          rays_(make_rays_engine(scene, caster)),
          starts_(make_rays_engine(scene, caster, 1, starts_along_column)) {
        if (scene.triangles.size() > many_triangles)
            dense_rays_ = make_rays_engine(scene, caster, density_over_many_triangles);
    }

    struct Strips {
        SceneClusters clusters;
        std::atomic<std::size_t> last_samples{0};  ///< in the last ping
    };

    std::unique_ptr<VisibilityEngine> rays_, starts_, dense_rays_;
    std::shared_ptr<Strips> strips_;  ///< null: rays; shared by the engines at all times
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree)
        return make_octree_engine(scene, settings.octree_leaf_m);
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
    if (scene.sound_profile && (is_octree || settings.type == EngineKind::strips))
        return engine + " needs straight paths of sound, and water.profile bends them" + instead;
    if (!is_octree) return "";
    if (!scene.bodies.empty()) return engine + " does not support moving objects" + instead;
    if (!scene.copies.empty())
        return engine + " does not support copies of shared meshes" + instead;
    return too_small_leaves((scene.bounds_max - scene.bounds_min).maxCoeff(),
                            settings.octree_leaf_m);
}

std::string unsupported(const EngineSettings& settings, const View& view) {
    if (settings.type != EngineKind::octree || !view.energies_add) return "";
    return "engine: octree has votes in place of areas, and model: calibrated needs areas; use "
           "engine: auto";
}

}  // namespace sonarsim
