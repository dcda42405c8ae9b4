#include "sonar/sonar.h"

#include "sonar/kinds.h"
#include "sonar/setup.h"

namespace sonarsim {

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy) {
    const KindOfSonar& kind = kind_of(config.kind);
    Sonar sonar = common_sonar(config, accuracy, kind);
    if (kind.finish) kind.finish(sonar);
    return sonar;
}

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key) {
    return run_pipeline(sonar.settings, scene, engine,
                        sensor_pose(sonar, T_world_vehicle, key.ping), key);
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
