#include "sonar/sonar.h"

#include "sonar/imaging.h"

namespace sonarsim {

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy) {
    switch (config.kind) {
        case SonarKind::imaging:
            return make_imaging(config, accuracy);
    }
    return {};
}

Ping render_ping(const Sonar& sonar, const Scene& scene, const Surface& surface,
                 const Pose& T_world_vehicle, const PingKey& key) {
    return run_pipeline(sonar.settings, scene, surface, T_world_vehicle * sonar.T_vehicle_sensor,
                        key);
}

}  // namespace sonarsim
