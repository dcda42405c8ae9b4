#pragma once

#include <span>

#include "core/elementary.h"
#include "input/scene/scene.h"
#include "simulate/calibrated/equation/seafloor_scattering.h"

namespace sonarsim {

/// The backscatter of a material per unit of area and solid angle: the cross-section sigma, whose
/// 10 log is the strength S, by Lambert's rule and facets or a sea bed's tables.
struct Backscatter {
    float lambert = 0.0F;         ///< mu of Lambert's rule, sigma = mu sin^2(grazing angle)
    float facet = 0.0F;           ///< sigma of the specular echo at normal incidence
    float inverse_slope2 = 0.0F;  ///< 1 / (2 s^2), s the root mean square slope of the facets
    float mirrored = 1.0F;        ///< share of the reflected sound that roughness leaves a mirror
    /// [AngularTable::size] The parts D and K of sigma of a sea bed; empty: the above holds.
    std::vector<float> diffuse, specular;

    /// sigma at the sine of the grazing angle, v . n. By Lambert's rule and facets it is
    ///
    ///     mu sin^2 + R / (8 pi s^2 sin^4) exp(-1 / (2 s^2 tan^2))
    ///
    /// The first is Lambert's rule (Mackenzie 1961), the second the high-frequency limit of the
    /// Kirchhoff integral over a surface of Gaussian slopes (e.g. Jackson and Richardson,
    /// "High-Frequency Seafloor Acoustics", Springer 2007, chapter 13), with R the power reflection
    /// times 1 - pi mu and `mirrored`. A sea bed has D + K.
    float at(float sine) const;

    /// sigma for incident and scattered sound at grazing angles of these sines. Its facets face
    /// halfway between the two directions; `half` is v . n of that direction:
    ///
    ///     mu sin_in sin_out + R / (8 pi s^2 half^4) exp(-(1 - half^2) / (2 s^2 half^2))
    ///
    /// A sea bed has sqrt(D(sine_in) D(sine_out)) + K(half). For backscatter it is at(sine).
    float between(float sine_in, float sine_out, float half) const;
};

/// Values by the sine of the grazing angle. They are dense near normal incidence, where the
/// Kirchhoff integral is steep: entry k has the sine 1 - (k / steps)^2.
struct AngularTable {
    static constexpr int steps = 1024;
    static constexpr int size = steps + 2;  ///< the last two are the same, for interpolation

    static double sine(int entry) {
        const double root = std::min(1.0, static_cast<double>(entry) / steps);
        return 1.0 - root * root;
    }
    static float value(const float* entries, float sine);
};

struct Scattering {
    std::vector<Backscatter> materials;
    /// [materials, AngularTable::size] at() of sea beds, 0 of other materials; empty: no sea beds.
    std::vector<float> sea_beds;
};

/// Sound of `frequency_hz` in `water`.
Scattering scattering_of(std::span<const Material> materials, double frequency_hz,
                         const Water& water);

void append(const Backscatter& tabled, Scattering& scattering);

/// `lambert_db`: 10 log mu. `reflection`: of power at normal incidence. `slope_rms`: of facets.
Backscatter backscatter(double lambert_db, double reflection, double slope_rms);
Backscatter backscatter(const SeafloorScattering& sea_bed);

/// `exp_neg` is 0 from here on. This suffices for facets: a power of 1e-19 is left.
inline constexpr float exp_neg_cutoff = 43.0F;
/// The same for absorption, which a gain may compensate: the least power that floats hold.
inline constexpr float min_loss = 87.0F;

/// e^-x for x >= -88, error below 3e-6; 0 from x = `longest` on and for NaN; no branches.
inline float exp_neg(float x, float longest = exp_neg_cutoff) {
    const float turns = std::min(longest, x) * 1.44269504F;
    const float whole = std::floor(turns);
    const float rest = (turns - whole) * 0.69314718F;
    const float series = polynomial(rest, 1.0F, -1.0F, 1.0F / 2, -1.0F / 6, 1.0F / 24, -1.0F / 120,
                                    1.0F / 720, -1.0F / 5040);
    const auto exponent = static_cast<std::int32_t>(whole);
    const float value = series * std::bit_cast<float>((127 - exponent) << 23);
    return x < longest ? value : 0.0F;
}

inline float AngularTable::value(const float* entries, float sine) {
    // In this order of arguments NaN becomes 0.
    const float at = std::sqrt(std::min(1.0F, std::max(0.0F, 1.0F - sine))) * steps;
    const float whole = std::floor(at);
    const auto k = static_cast<std::size_t>(whole);
    return std::fma(at - whole, entries[k + 1] - entries[k], entries[k]);
}

inline float Backscatter::between(float sine_in, float sine_out, float half) const {
    if (!diffuse.empty()) {
        return std::sqrt(AngularTable::value(diffuse.data(), sine_in) *
                         AngularTable::value(diffuse.data(), sine_out)) +
               AngularTable::value(specular.data(), half);
    }
    const float near = std::max(1e-6F, half * half);
    return lambert * sine_in * sine_out +
           facet / (near * near) * exp_neg(inverse_slope2 * (1.0F - near) / near);
}

inline float Backscatter::at(float sine) const {
    if (!diffuse.empty())
        return AngularTable::value(diffuse.data(), sine) +
               AngularTable::value(specular.data(), sine);
    const float s2 = sine * sine;
    const float near = std::max(1e-6F, s2);
    return lambert * s2 + facet / (near * near) * exp_neg(inverse_slope2 * (1.0F - near) / near);
}

/// The share of the power that passes a wall of thickness d, with water on both sides, at normal
/// incidence (Kinsler et al., "Fundamentals of Acoustics", 4th edition, Wiley 2000, section 6.3):
///
///     T = 1 / (1 + (z / z_w - z_w / z)^2 sin^2(k d) / 4),    k = 2 pi f / c
///
/// The wall reflects the rest. 0 for a material without a wall.
double wall_transmission(const Material& material, double frequency_hz, const Water& water);

/// T^2, out and back, by material; empty if none is a wall.
std::vector<float> two_way_transmissions(std::span<const Material> materials, double frequency_hz,
                                         const Water& water);

/// Backscattering from the surface of the water below wind of `wind_m_s`: sigma per area and solid
/// angle, whose 10 log is the strength S. `grazing_rad`: 0 to pi / 2.
///
/// From 10 kHz on the model of the Applied Physics Laboratory, University of Washington (APL-UW TR
/// 9407, 1994, section II): facets near normal incidence, small waves elsewhere, both weakened by
/// the bubbles below them, and the echo of these bubbles. It was made for 10 to 100 kHz and is an
/// extrapolation above. Below 10 kHz it is the fit of R. P. Chapman and J. H. Harris, J. Acoust.
/// Soc. Am. 34 (1962) 1592, which was measured from 0.4 to 6.4 kHz below 40 degrees, same facets.
double wind_surface_section(double grazing_rad, double wind_m_s, double frequency_hz);

/// The same as a material.
Backscatter wind_surface(double wind_m_s, double frequency_hz);

}  // namespace sonarsim
