#include "sonar/sonar.h"

#include "sonar/echosounder.h"
#include "sonar/imaging.h"
#include "sonar/profiling.h"
#include "sonar/sidescan.h"

namespace sonarsim {

bool has_images(const Sonar& sonar) {
    return sonar.config.kind == SonarKind::imaging || sonar.config.kind == SonarKind::profiling;
}

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

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key) {
    return run_pipeline(sonar.settings, scene, engine, T_world_vehicle * sonar.T_vehicle_sensor,
                        key);
}

std::array<Ping, 5> render_stages(const Sonar& sonar, const Scene& scene,
                                  const VisibilityEngine& engine, const Pose& T_world_vehicle,
                                  const PingKey& key) {
    Sonar pruned = sonar;
    PingSettings& settings = pruned.settings;
    const auto render = [&] { return render_ping(pruned, scene, engine, T_world_vehicle, key); };
    std::array<Ping, 5> stages;
    stages[4] = render();
    settings.streaks.mode = StreakMode::none;
    stages[3] = render();
    settings.pixel_noise.gain = 1.0F;
    settings.pixel_noise.add_sigma = settings.pixel_noise.mult_sigma = 0.0F;
    stages[2] = render();
    settings.range_noise.lambda_m = 0.0F;
    stages[1] = render();
    settings.multipath.on = false;
    stages[0] = render();
    return stages;
}

}  // namespace sonarsim
