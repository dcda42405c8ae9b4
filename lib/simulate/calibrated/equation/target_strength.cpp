#include "simulate/calibrated/equation/target_strength.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/calibrated/signal/decibel.h"

namespace sonarsim {

double fish_section_m2(double length_m, double frequency_hz) {
    const double length_db = db_of_power(100.0 * length_m);  // 10 log of centimetres
    return power_of_db(1.91 * length_db - 0.09 * db_of_power(1e-3 * frequency_hz) - 62.0);
}

double bubble_section_m2(double radius_m, double depth_m, double density_kg_m3,
                         double sound_speed_m_s, double frequency_hz) {
    constexpr double gamma = 1.4;  // ratio of the specific heats of air
    constexpr double air_pa = 101325.0;
    constexpr double gravity_m_s2 = 9.81;
    const double pressure = air_pa + density_kg_m3 * gravity_m_s2 * std::max(0.0, depth_m);
    const double resonance_hz =
        std::sqrt(3.0 * gamma * pressure / density_kg_m3) / (2.0 * pi * radius_m);
    const double ka = 2.0 * pi * frequency_hz / sound_speed_m_s * radius_m;
    const double ratio = resonance_hz / frequency_hz;
    const double off = ratio * ratio - 1.0;
    const double share = 1.0 / (off * off + ka * ka);
    return radius_m * radius_m * (ka > 1.0 ? std::max(share, 0.25) : share);
}

}  // namespace sonarsim
