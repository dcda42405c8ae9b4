#include "run/checks/find_warnings.h"

#include <string>
#include <utility>

#include "simulate/sonar/engine_settings.h"

namespace sonarsim {

namespace {

void append(std::vector<Warning>& out, std::vector<Warning> more) {
    for (Warning& warning : more)
        out.push_back(std::move(warning));
}

}  // namespace

std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out = reading_warnings(assembly.scene);
    append(out, material_warnings(mission.water, assembly.scene));
    append(out, settings_warnings(mission, assembly));
    return out;
}

std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays) {
    std::vector<Warning> out = warnings_before_pings(mission, assembly);
    append(out, scene_warnings(mission, assembly, sonars));
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        append(out, sonar_warnings(mission.output, assembly.sonars[i], assembly.full_scales[i],
                                   sonars[i]));
    }
    append(out, hidden_objects(mission, assembly, sonars, rays));
    return out;
}

}  // namespace sonarsim
