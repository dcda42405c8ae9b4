#include "assembly/engine_probes.h"

#include "assembly/sample_pings.h"
#include "ping/sonar.h"
#include "sonar/engine_settings.h"
#include "trace/visible_surface.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_probes = 3;  // per sonar

/// The rays that a sonar needs; a goal of 0: slices suffice.
RaysNeed rays_need(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const RaysNeed of_model = sonar.settings.model->rays_need(view);
    if (of_model.goal > 0.0) return of_model;
    // Multipath continues from the middle of each sample, and a sample of the slices may be as long
    // as a beam is high.
    return {.goal =
                sonar.config.multipath.method != MultipathMethod::none ? view.relative_l1 : 0.0};
}

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineKind::automatic) return settings;
    for (const Sonar& sonar : assembly.sonars) {
        for (const std::uint32_t pose :
             sample_pings(assembly.trajectory.size(), sonar.config.every, most_probes)) {
            settings.probes.push_back(
                {traced_view(sonar.settings.view, sonar.settings.guard_beams),
                 sensor_pose(sonar, assembly.trajectory[pose].T_world_vehicle, pose),
                 rays_need(sonar)});
        }
    }
    return settings;
}

std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission, assembly);
    settings.caster = assembly.caster;
    return make_engine(assembly.scene, settings);
}

}  // namespace sonarsim
