#include "sonar/profiling.h"

#include "sonar/setup.h"

namespace sonarsim {

Sonar make_profiling(const SonarConfig& config, const AccuracyConfig& accuracy) {
    Sonar sonar = common_sonar(config, accuracy, ViewShape::fan, config.azimuth_bins, 0.5);
    sonar.T_vehicle_sensor = mounted(config.mount, looking_down());
    add_azimuth(sonar);
    return sonar;
}

}  // namespace sonarsim
