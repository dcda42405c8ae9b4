#pragma once

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

}  // namespace sonarsim
