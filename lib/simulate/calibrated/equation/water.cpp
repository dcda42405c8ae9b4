#include "simulate/calibrated/equation/water.h"

#include <algorithm>
#include <cmath>

#include "core/decibel.h"
#include "core/units.h"

namespace sonarsim {

namespace {

double power_of_ten(double x) {
    return exponential(x * ln_10);
}

/// Loss by a relaxation at `f_relax`, in units of its strength.
double relaxation(double f_khz, double f_relax) {
    return f_relax * f_khz * f_khz / (f_relax * f_relax + f_khz * f_khz);
}

/// Viscosity of pure water, dB / (km kHz^2). The fit is in two pieces that meet at 20 degrees.
double pure_water(double t) {
    if (t <= 20.0) return 4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - t * 1.50e-8));
    return 3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - t * 6.5e-10));
}

}  // namespace

double absorption_db_per_m(double frequency_hz, const WaterState& water) {
    const double f = 1e-3 * frequency_hz;
    const double t = water.temperature_c;
    const double s = water.salinity_psu;
    const double z = water.depth_m;
    const double kelvin = t + 273.0;
    // The speed that the authors used in their fit; not Mackenzie's.
    const double c = 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * z;

    const double boric = 8.86 / c * power_of_ten(0.78 * water.ph - 5.0);
    const double f_boric = 2.8 * std::sqrt(s / 35.0) * power_of_ten(4.0 - 1245.0 / kelvin);
    const double sulphate = 21.44 * s / c * (1.0 + 0.025 * t);
    const double sulphate_pressure = 1.0 + z * (-1.37e-4 + z * 6.2e-9);
    const double f_sulphate =
        8.17 * power_of_ten(8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));
    const double water_pressure = 1.0 + z * (-3.83e-5 + z * 4.9e-10);

    // Fresh water has no boric acid to relax.
    const double by_boric = s > 0.0 ? boric * relaxation(f, f_boric) : 0.0;
    const double db_per_km = by_boric + sulphate * sulphate_pressure * relaxation(f, f_sulphate) +
                             pure_water(t) * water_pressure * f * f;
    return 1e-3 * db_per_km;
}

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
