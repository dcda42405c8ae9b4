#include "assembly/engine_probes.h"

#include "core/units.h"
#include "ping/sonar.h"
#include "sonar/engine_settings.h"
#include "trace/visible_surface.h"

namespace sonarsim {

namespace {

// Slices meet at the sonar's z axis, so all of them hold the surface near it.
constexpr double widest_slices_rad = 0.5 * pi;

/// The rays that a sonar needs; a goal of 0: slices suffice.
RaysNeed rays_need(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const int columns = sonar.settings.model->info.ray_columns;
    if (columns > 0) return {.goal = view.relative_l1, .columns = columns};
    // Multipath continues from the middle of each sample, and a sample of the slices may be as long
    // as a beam is high.
    const bool by_rays = sonar.config.multipath.method != MultipathMethod::none ||
                         view.elevation_rad > widest_slices_rad;
    return {.goal = by_rays ? view.relative_l1 : 0.0};
}

/// The views that the trace of a sonar's pings has.
std::vector<Sight> traced_sights(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const GuardBeams& guards = sonar.settings.guard_beams;
    if (view.elevation_rad > widest_slices_rad) return sights(view, guards, Pose{});
    return {{traced_view(view, guards), Pose{}}};
}

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineKind::automatic) return settings;
    for (const Sonar& sonar : assembly.sonars) {
        for (const Sight& sight : traced_sights(sonar))
            settings.probes.push_back({sight.view, sight.T_world_sensor, rays_need(sonar)});
    }
    return settings;
}

std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission, assembly);
    settings.caster = assembly.caster;
    return make_engine(assembly.scene, settings);
}

}  // namespace sonarsim
