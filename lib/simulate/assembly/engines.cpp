#include "simulate/assembly/engines.h"

#include "simulate/ping/sonar.h"
#include "simulate/sonar/engine_settings.h"
#include "simulate/trace/visible_surface.h"

namespace sonarsim {

namespace {

/// True if rays trace a sonar. Multipath continues from the middle of each sample, and a sample of
/// the strips may be as long as a beam is high. If rays trace all sonars, no strips are prepared.
bool is_by_rays(const Sonar& sonar, const Scene& scene) {
    const View& view = sonar.settings.view;
    return sonar.config.multipath.method != MultipathMethod::none ||
           (view.energies_add && !suits_strips(view, scene.triangles.size()));
}

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineKind::automatic) return settings;
    bool all_by_rays = true;
    for (const Sonar& sonar : assembly.sonars) {
        const bool by_rays = is_by_rays(sonar, assembly.scene);
        all_by_rays = all_by_rays && by_rays;
        if (!by_rays) continue;
        for (const Sight& sight : sights(sonar.settings.view, {}))
            settings.by_rays.push_back(sight.view);
    }
    if (all_by_rays) settings.type = EngineKind::rays;
    return settings;
}

std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission, assembly);
    if (settings.type != EngineKind::octree)
        settings.caster = std::make_shared<const Caster>(assembly.make_caster());
    return make_engine(assembly.scene, settings);
}

}  // namespace sonarsim
