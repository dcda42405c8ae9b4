#pragma once

#include <algorithm>

#include "mission/mission.h"

namespace sonarsim {

/// Speed of sound, m/s, by temperature, salinity and depth: K. V. Mackenzie, "Nine-term equation
/// for sound speed in the oceans", J. Acoust. Soc. Am. 70 (1981), 807. Made for 2 to 30 degrees, 25
/// to 40 psu, down to 8000 m; in fresh water it is too low by 1 m/s or so.
inline double sound_speed_m_s(const WaterConfig& water) {
    const double t = water.temperature_c;
    const double s = water.salinity_psu - 35.0;
    const double d = water.depth_m;
    return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * s +
           1.630e-2 * d + 1.675e-7 * d * d - 1.025e-2 * t * s - 7.139e-13 * t * d * d * d;
}

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
