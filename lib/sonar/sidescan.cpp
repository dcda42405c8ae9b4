#include "sonar/sidescan.h"

#include "sonar/setup.h"

namespace sonarsim {

Sonar make_sidescan(const SonarConfig& config, const AccuracyConfig& accuracy) {
    Sonar sonar = common_sonar(config, accuracy, ViewShape::sides, 2, 1.0);
    sonar.T_vehicle_sensor = mounted(config.mount, looking_down());
    return sonar;
}

}  // namespace sonarsim
