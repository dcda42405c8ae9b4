#include "sonar/sonar.h"

#include <algorithm>

#include "sonar/echosounder.h"
#include "sonar/imaging.h"
#include "sonar/profiling.h"
#include "sonar/sidescan.h"

namespace sonarsim {

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy) {
    switch (config.kind) {
        case SonarKind::imaging:
            return make_imaging(config, accuracy);
        case SonarKind::profiling:
            return make_profiling(config, accuracy);
        case SonarKind::sidescan:
            return make_sidescan(config, accuracy);
        case SonarKind::echosounder:
            return make_echosounder(config, accuracy);
    }
    return {};
}

TracedPing trace(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const Terms& terms) {
    return trace_ping(sonar.settings, scene, engine, T_world_vehicle * sonar.T_vehicle_sensor,
                      terms);
}

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key, const Terms& terms) {
    return form_image(trace(sonar, scene, engine, T_world_vehicle, terms), sonar.settings, scene,
                      key, terms);
}

std::array<Ping, 5> form_stages(const TracedPing& traced, const Sonar& sonar, const Scene& scene,
                                const PingKey& key) {
    std::array<Ping, 5> stages;
    std::ranges::transform(term_by_term, stages.begin(), [&](const Terms& terms) {
        return form_image(traced, sonar.settings, scene, key, terms);
    });
    return stages;
}

}  // namespace sonarsim
