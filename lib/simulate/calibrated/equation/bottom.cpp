#include "simulate/calibrated/equation/bottom.h"

#include <cmath>

#include "core/decibel.h"
#include "core/units.h"
#include "input/scene/materials.h"

namespace sonarsim {

namespace {

/// Scattering::sea_beds of materials.
std::vector<float> tables_of(std::span<const Backscatter> materials) {
    std::vector<float> out;
    for (const Backscatter& material : materials) {
        for (std::size_t k = 0; k < AngularTable::size; ++k) {
            const bool tabled = !material.diffuse.empty();
            out.push_back(tabled ? material.diffuse[k] + material.specular[k] : 0.0F);
        }
    }
    return out;
}

/// The backscatter of a surface of facets. Heights of the root mean square h leave a mirror the
/// share exp(-2 (k h)^2) of the reflected sound, at a grazing angle of 45 degrees, and Lambert's
/// rule has the rest: R (1 - exp(-2 (k h)^2)) / pi more. h by the roughness that flow meets (Flack
/// and Schultz, J. Fluids Eng. 132 (2010), 041203).
Backscatter facets_of(const Material& material, double reflection, double wavenumber) {
    constexpr double flow_per_height = 4.43;
    const double slope = facet_slope(material);
    if (!material.roughness_mm) return backscatter(material.lambert_db, reflection, slope);
    const double kh = wavenumber * 1e-3 * *material.roughness_mm / flow_per_height;
    const double mirrored = exponential(-2.0 * kh * kh);
    Backscatter out = backscatter(material.lambert_db, mirrored * reflection, slope);
    out.lambert += static_cast<float>(reflection * (1.0 - mirrored) / pi);
    out.mirrored = static_cast<float>(mirrored);
    return out;
}

}  // namespace

Backscatter backscatter(double lambert_db, double reflection, double slope_rms) {
    Backscatter out;
    out.lambert = static_cast<float>(power_of_db(lambert_db));
    if (slope_rms <= 0.0) return out;
    // Lambert's rule scatters the share pi mu of the sound; facets reflect the rest.
    const double rest = std::max(0.0, 1.0 - pi * power_of_db(lambert_db));
    const double two_s2 = 2.0 * slope_rms * slope_rms;
    out.facet = static_cast<float>(reflection * rest / (4.0 * pi * two_s2));
    out.inverse_slope2 = static_cast<float>(1.0 / two_s2);
    return out;
}

Backscatter backscatter(const SeafloorScattering& sea_bed) {
    // The specular part has the integral R / 4 over all directions. A peak narrower than the first
    // entry, a tent of radius sqrt(2) / steps, is limited to this integral.
    constexpr double tent = pi / 3.0 * 2.0 / (AngularTable::steps * AngularTable::steps);
    const double max_specular = 0.25 * sea_bed.reflection() / tent;
    Backscatter out;
    for (int k = 0; k < AngularTable::size; ++k) {
        const double grazing_rad = arcsin(AngularTable::sine(k));
        out.diffuse.push_back(static_cast<float>(sea_bed.diffuse(grazing_rad)));
        out.specular.push_back(
            static_cast<float>(std::min(max_specular, sea_bed.specular(grazing_rad))));
    }
    return out;
}

Scattering scattering_of(std::span<const Material> materials, double frequency_hz,
                         const Water& water) {
    const double wavenumber = 2.0 * pi * frequency_hz / water.sound_speed_m_s;
    Scattering out;
    for (const Material& material : materials) {
        if (is_sea_bed(material)) {
            out.materials.push_back(
                backscatter(SeafloorScattering(sea_bed_of(material, water), wavenumber)));
        } else {
            const double reflection = material.wall_mm
                                          ? 1.0 - wall_transmission(material, frequency_hz, water)
                                          : double{material.reflection};
            out.materials.push_back(facets_of(material, reflection, wavenumber));
        }
    }
    if (std::ranges::any_of(materials, is_sea_bed)) out.sea_beds = tables_of(out.materials);
    return out;
}

void append(const Backscatter& tabled, Scattering& scattering) {
    scattering.materials.push_back(tabled);
    scattering.sea_beds = tables_of(scattering.materials);
}

double wall_transmission(const Material& material, double frequency_hz, const Water& water) {
    if (!material.wall_mm) return 0.0;
    const double ratio = material.density_kg_m3 * material.sound_speed_m_s /
                         (water.density_kg_m3 * water.sound_speed_m_s);
    const double waves = 1e-3 * *material.wall_mm * frequency_hz / material.sound_speed_m_s;
    const double x = (ratio - 1.0 / ratio) * sincos(2.0 * pi * (waves - std::floor(waves))).sin;
    return 1.0 / (1.0 + 0.25 * x * x);
}

std::vector<float> two_way_transmissions(std::span<const Material> materials, double frequency_hz,
                                         const Water& water) {
    std::vector<float> out;
    if (std::ranges::none_of(materials, [](const Material& m) { return m.wall_mm.has_value(); }))
        return out;
    for (const Material& material : materials) {
        const double once = wall_transmission(material, frequency_hz, water);
        out.push_back(static_cast<float>(once * once));
    }
    return out;
}

}  // namespace sonarsim
