#include "simulate/visibility/make_engine.h"

#include <atomic>

#include "simulate/visibility/octree/tree.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/strips/strips.h"

namespace sonarsim {

namespace {

/// In scenes of more triangles `auto` takes rays, as their time hardly depends on them,
constexpr std::size_t strips_triangles_max = std::size_t{1} << 19;

/// but not for views of fewer than this,
constexpr std::size_t strips_in_view_max = std::size_t{1} << 17;

/// if the meshes have no more, since the clusters of strips take memory.
constexpr std::size_t clusters_triangles_max = std::size_t{1} << 22;

// Factors on the rays over many triangles, where bins hold means, and on the starts of multipath.
constexpr int density_over_many_triangles = 4;
constexpr int starts_along_column = 4;

/// Strips, or rays over many triangles. Multipath starts where rays meet the surface.
class StripsOrRays final : public VisibilityEngine {
  public:
    /// Views of more triangles than `strips_max` are those of rays.
    StripsOrRays(const Scene& scene, const Caster& caster, std::size_t strips_max)
        : StripsOrRays(scene, caster) {
        if (strips_max > 0) strips_.reset(new Strips{SceneClusters(scene), strips_max});
    }

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const std::optional<ClustersInView> clusters =
            strips_ ? strips_->clusters.in_view(view, T_world_sensor, body_poses(),
                                                strips_->max_triangles)
                    : std::nullopt;
        if (clusters) {
            Samples out = strips_surface(*clusters, view,
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
        std::size_t max_triangles;
        std::atomic<std::size_t> last_samples{0};  ///< in the last ping
    };

    std::unique_ptr<VisibilityEngine> rays_, starts_, dense_rays_;
    std::shared_ptr<Strips> strips_;  ///< null: rays; shared by the engines at all times
};

/// The greatest number of triangles in view for strips; 0: there are none.
std::size_t strips_max(const Scene& scene, EngineKind engine) {
    constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
    if (engine == EngineKind::strips) return any;
    std::size_t meshes = scene.triangles.size();
    for (const Body& body : scene.bodies)
        meshes += body.triangles.size();
    std::size_t placed = meshes;
    for (const SharedMesh& mesh : scene.shared_meshes)
        meshes += mesh.triangles.size();
    for (const MeshCopy& copy : scene.copies)
        placed += scene.shared_meshes[copy.mesh].triangles.size();
    if (placed <= strips_triangles_max) return any;
    return meshes <= clusters_triangles_max ? strips_in_view_max : 0;
}

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree)
        return make_octree_engine(scene, settings.octree_leaf_m);
    const Caster caster = settings.caster ? *settings.caster : Caster(scene);
    if (settings.type == EngineKind::rays || scene.sound_profile)
        return make_rays_engine(scene, caster);
    return std::make_unique<StripsOrRays>(scene, caster, strips_max(scene, settings.type));
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
