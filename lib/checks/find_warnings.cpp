#include "checks/find_warnings.h"

#include <utility>

#include "checks/scene_warnings.h"
#include "checks/sonar_warnings.h"
#include "checks/trajectory_warnings.h"
#include "checks/unseen_objects.h"
#include "sonar/engine_settings.h"

namespace sonarsim {

std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays) {
    std::vector<Warning> out;
    const auto append = [&](std::vector<Warning> more) {
        for (Warning& warning : more)
            out.push_back(std::move(warning));
    };
    append(scene_warnings(mission, assembly, sonars));
    append(trajectory_warnings(mission.trajectory, assembly.trajectory));
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        const Sonar& sonar = assembly.sonars[i];
        append(sonar_warnings(mission.output, sonar, assembly.full_scales[i], sonars[i]));
        const std::string doubt =
            accuracy_warning(engine_settings(mission), sonar.settings.view,
                             sonar.settings.multipath.on, sonar.settings.model->energies_add());
        if (!doubt.empty())
            out.push_back(make_warning(Doubt::engine, about_sensor(sonar.config.name), doubt));
    }
    append(unseen_objects(mission, assembly, sonars, rays));
    return out;
}

}  // namespace sonarsim
