#include "sonar/imaging.h"

#include "core/units.h"
#include "sonar/setup.h"

namespace sonarsim {

Sonar make_imaging(const SonarConfig& config, const AccuracyConfig& accuracy) {
    Sonar sonar;
    sonar.config = config;
    sonar.T_vehicle_sensor = mounted(config.mount, Pose{});
    sonar.range_edges_m = edges(config.range_min_m, config.range_max_m, config.range_bins);
    sonar.azimuth_edges_rad = edges(-0.5 * radians(config.azimuth_deg),
                                    0.5 * radians(config.azimuth_deg), config.azimuth_bins);
    PingSettings& settings = sonar.settings;
    settings.stream = stream_of(config.name);
    settings.view = {radians(config.azimuth_deg), radians(config.elevation_deg),
                     config.range_min_m,          config.range_max_m,
                     config.range_bins,           config.azimuth_bins,
                     accuracy.relative_l1};
    settings.range_noise = {static_cast<float>(config.noise.range_lambda_m),
                            static_cast<float>(config.noise.scatterer_m), true};
    settings.pixel_noise = pixel_noise(config, 0.5, sonar.range_edges_m, sonar.azimuth_edges_rad);
    return sonar;
}

}  // namespace sonarsim
