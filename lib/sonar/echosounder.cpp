#include "sonar/echosounder.h"

#include "sonar/setup.h"

namespace sonarsim {

Sonar make_echosounder(const SonarConfig& config, const AccuracyConfig& accuracy) {
    Sonar sonar = common_sonar(config, accuracy, ViewShape::cone, 1, 1.0);
    sonar.T_vehicle_sensor = mounted(config.mount, looking_down());
    sonar.settings.view.elevation_rad = sonar.settings.view.azimuth_rad;
    sonar.settings.range_noise.fades = false;
    return sonar;
}

}  // namespace sonarsim
