#pragma once

#include <algorithm>

#include "mission/mission.h"

namespace sonarsim {

/// True if the water scatters sound back to every sonar, whatever its usual water.
inline bool scatters(const WaterConfig& water) {
    const bool has_content =
        water.content != WaterContent::none && water.content != WaterContent::automatic;
    return has_content || water.scattering_db_per_m3 || !water.layers.empty();
}

/// True if the water scatters sound back to some sonar.
inline bool some_water_scatters(const Mission& mission) {
    const bool is_usual = mission.water.content == WaterContent::automatic;
    return scatters(mission.water) ||
           std::ranges::any_of(mission.sensors, [&](const SonarConfig& sensor) {
               return is_usual && sensor.model == ModelKind::calibrated &&
                      sensor.instrument.usual_water != WaterContent::none;
           });
}

}  // namespace sonarsim
