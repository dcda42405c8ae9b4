#include "simulate/calibrated/ambient_noise.h"

#include <cmath>

#include "simulate/calibrated/decibel.h"

namespace sonarsim {

double thermal_noise_db(double frequency_hz) {
    return -15.0 + 2.0 * db_of_power(1e-3 * frequency_hz);
}

double wind_noise_db(double frequency_hz, double wind_m_s) {
    const double f_khz = 1e-3 * frequency_hz;
    return 50.0 + 7.5 * std::sqrt(wind_m_s) + 2.0 * db_of_power(f_khz) -
           4.0 * db_of_power(f_khz + 0.4);
}

}  // namespace sonarsim
