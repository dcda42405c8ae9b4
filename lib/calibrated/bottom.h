#pragma once

#include <algorithm>

#include "core/elementary.h"

namespace sonarsim {

/// The backscatter of a material per unit of area and solid angle: the scattering cross-section
/// sigma, whose 10 log is the backscattering strength S.
struct Backscatter {
    float lambert = 0.0F;         ///< mu of Lambert's rule, sigma = mu sin^2(grazing angle)
    float facet = 0.0F;           ///< sigma of the specular echo at normal incidence
    float inverse_slope2 = 0.0F;  ///< 1 / (2 s^2), s the root mean square slope of the facets

    /// sigma where `sine` is that of the grazing angle, v . n:
    ///
    ///     mu sin^2 + R / (8 pi s^2 sin^4) exp(-1 / (2 s^2 tan^2))
    ///
    /// The first is Lambert's rule (Mackenzie 1961), the second the high-frequency limit of the
    /// Kirchhoff integral over a surface of Gaussian slopes (e.g. Jackson and Richardson,
    /// "High-Frequency Seafloor Acoustics", Springer 2007, chapter 13).
    float at(float sine) const;

    /// sigma of sound that comes and goes at grazing angles of these sines, and whose facets face
    /// halfway between the two directions, v . n of which is `half`:
    ///
    ///     mu sin_in sin_out + R / (8 pi s^2 half^4) exp(-(1 - half^2) / (2 s^2 half^2))
    ///
    /// Both ways along one direction it is at(sine).
    float between(float sine_in, float sine_out, float half) const;
};

/// The material with `lambert_db` = 10 log mu, power reflection R at normal incidence and facets of
/// slope s; s = 0 has no facets.
Backscatter backscatter(double lambert_db, double reflection, double slope_rms);

/// `exp_neg` is 0 from here on. Facets need no more: a power of 1e-19 is left.
inline constexpr float fades_at = 43.0F;
/// The same for absorption, which a gain may compensate: the least power that floats hold.
inline constexpr float least_loss = 87.0F;

/// e^-x for x >= -88, relative error below 3e-6; 0 from x = `longest` on and for NaN. Without
/// branches.
inline float exp_neg(float x, float longest = fades_at) {
    const float turns = std::min(longest, x) * 1.44269504F;
    const float whole = std::floor(turns);
    const float rest = (turns - whole) * 0.69314718F;
    const float series = polynomial(rest, 1.0F, -1.0F, 1.0F / 2, -1.0F / 6, 1.0F / 24, -1.0F / 120,
                                    1.0F / 720, -1.0F / 5040);
    const auto exponent = static_cast<std::int32_t>(whole);
    const float value = series * std::bit_cast<float>((127 - exponent) << 23);
    return x < longest ? value : 0.0F;
}

inline float Backscatter::between(float sine_in, float sine_out, float half) const {
    const float near = std::max(1e-6F, half * half);
    return lambert * sine_in * sine_out +
           facet / (near * near) * exp_neg(inverse_slope2 * (1.0F - near) / near);
}

inline float Backscatter::at(float sine) const {
    const float s2 = sine * sine;
    const float near = std::max(1e-6F, s2);
    return lambert * s2 + facet / (near * near) * exp_neg(inverse_slope2 * (1.0F - near) / near);
}

}  // namespace sonarsim
