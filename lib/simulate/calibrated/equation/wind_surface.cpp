#include "core/decibel.h"
#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/equation/bottom.h"

namespace sonarsim {

namespace {

constexpr double high_from_hz = 10e3;
// Smallest angle at which both models are evaluated: their strengths stay finite.
constexpr double min_grazing_rad = radians(0.1);

/// The mean square slope of the waves. Below 1 m/s that at 1 m/s, where the report jumps to 0.034.
double square_slope(double wind_m_s) {
    return wind_m_s < 1.0 ? 0.0034 : 4.6e-3 * logarithm(2.1 * wind_m_s * wind_m_s);
}

/// Facets that face the sonar; the high-frequency limit of the Kirchhoff integral.
double facets(double sine, double slope2) {
    const double s2 = sine * sine;
    return exponential(-(1.0 / s2 - 1.0) / slope2) / (4.0 * pi * slope2 * s2 * s2);
}

/// The grazing angle in degrees at which the facets have fallen by 15 dB.
double joint_deg(double slope2) {
    const double min_strength = facets(1.0, slope2) / power_of_db(15.0);
    double low = 0.0;
    double high = 90.0;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (facets(std::max(sincos(radians(middle)).sin, 0.05), slope2) < min_strength ? low : high) =
            middle;
    }
    return 0.5 * (low + high);
}

/// The echo of the bubbles below the surface.
double bubbles(double sine, double wind_m_s, double khz) {
    constexpr double resonant_damping = 0.0136;
    const double damping = 2.55e-2 * power(khz, 1.0 / 3.0);
    const double calm = std::min(wind_m_s, 11.0);
    const double windy = power(std::max(wind_m_s, 11.0) / 11.0, 3.5);
    const double beta =
        power(khz / 25.0, 0.85) * exponential(ln_10 * (-5.2577 + 0.4701 * calm)) * windy;
    const double b = beta / sine;
    const double shape =
        (1.0 + 8.0 * b * exponential(-2.0 * b) - exponential(-4.0 * b)) / (2.0 * b);
    return beta * resonant_damping / (4.0 * pi * damping) * shape;
}

/// The two-way loss in these bubbles, dB.
double bubble_loss_db(double sine, double wind_m_s, double khz) {
    const double by_wind =
        wind_m_s >= 6.0 ? power(wind_m_s, 1.57) : power(6.0, 1.57) * exponential(wind_m_s - 6.0);
    return 1.26e-3 / sine * by_wind * power(khz, 0.85);
}

double high_frequency(double grazing_rad, double wind_m_s, double khz) {
    const double slope2 = square_slope(wind_m_s);
    const auto [sine, cosine] = sincos(grazing_rad);
    const double grazing_deg = degrees(grazing_rad);
    const double tangent = sine / std::max(cosine, 1e-6);
    const double small_waves =
        grazing_deg <= 85.0 ? 1.3e-5 * wind_m_s * tangent * tangent * tangent * tangent : 0.0;
    const double away = std::clamp(0.524 * (joint_deg(slope2) - grazing_deg), -80.0, 80.0);
    const double share = 1.0 / (1.0 + exponential(away));
    const double rough = share * facets(sine, slope2) + (1.0 - share) * small_waves;
    return rough * power_of_db(-bubble_loss_db(sine, wind_m_s, khz)) + bubbles(sine, wind_m_s, khz);
}

double low_frequency(double grazing_rad, double wind_m_s, double frequency_hz) {
    constexpr double knots = 3600.0 / 1852.0;
    // In a calm the fit grows without bound.
    const double wind_kn = knots * std::max(wind_m_s, 0.5);
    const double b = 158.0 * power(wind_kn * power(frequency_hz, 1.0 / 3.0), -0.58);
    const double log_10_b = logarithm(b) / ln_10;
    const double by_angle = logarithm(degrees(grazing_rad) / 30.0) / ln_10;
    const double fit_db = 3.3 * b * by_angle - 42.4 * log_10_b + 2.6;
    return power_of_db(fit_db) + facets(sincos(grazing_rad).sin, square_slope(wind_m_s));
}

}  // namespace

double wind_surface_section(double grazing_rad, double wind_m_s, double frequency_hz) {
    const double grazing = std::max(grazing_rad, min_grazing_rad);
    return frequency_hz < high_from_hz ? low_frequency(grazing, wind_m_s, frequency_hz)
                                       : high_frequency(grazing, wind_m_s, 1e-3 * frequency_hz);
}

Backscatter wind_surface(double wind_m_s, double frequency_hz) {
    Backscatter out;
    for (int k = 0; k < AngularTable::size; ++k) {
        out.diffuse.push_back(static_cast<float>(
            wind_surface_section(arcsin(AngularTable::sine(k)), wind_m_s, frequency_hz)));
    }
    out.specular.assign(AngularTable::size, 0.0F);
    return out;
}

}  // namespace sonarsim
