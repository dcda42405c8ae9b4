#include "checks/find_warnings.h"

#include <algorithm>
#include <string>
#include <utility>

#include "product/fan.h"
#include "sonar/engine_settings.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

void append(std::vector<Warning>& out, std::vector<Warning> more) {
    for (Warning& warning : more)
        out.push_back(std::move(warning));
}

void judge_engine(const Mission& mission, const Sonar& sonar, std::vector<Warning>& out) {
    const std::string warning =
        accuracy_warning(engine_settings(mission), sonar.settings.view, sonar.settings.multipath.on,
                         sonar.settings.model->energies_add());
    if (!warning.empty())
        out.push_back(make_warning(WarningCode::engine, about_sensor(sonar.config.name), warning));
}

void judge_fan(const OutputConfig& output, const Sonar& sonar, std::vector<Warning>& out) {
    if (!output.fan || !kind_of(sonar.config.kind).has_images) return;
    const double pixel_m = fan_frame(sonar, output.fan_width_px).pixel_m;
    const double width_m = sonar.settings.view.azimuth_rad * sonar.config.range_max_m;
    if (width_m >= pixel_m) return;
    out.push_back(make_warning(WarningCode::thin_fan, about_sensor(sonar.config.name),
                               sonar.config.azimuth_deg, width_m, pixel_m));
}

}  // namespace

std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out = reading_warnings(assembly.scene);
    append(out, material_warnings(mission.water, assembly.scene));
    append(out, mission_warnings(mission, assembly.trajectory));
    for (const Sonar& sonar : assembly.sonars) {
        judge_engine(mission, sonar, out);
        judge_fan(mission.output, sonar, out);
    }
    return out;
}

std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays) {
    std::vector<Warning> out = warnings_before_pings(mission, assembly);
    append(out, scene_warnings(mission, assembly, sonars));
    append(out, trajectory_warnings(mission.trajectory, assembly.trajectory));
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        append(out, sonar_warnings(mission.output, assembly.sonars[i], assembly.full_scales[i],
                                   sonars[i]));
    }
    ask_for_units(mission, assembly.scene, out);
    append(out, unseen_objects(mission, assembly, sonars, rays));
    append(out, unseen_particles(mission, assembly, rays));
    return out;
}

}  // namespace sonarsim
