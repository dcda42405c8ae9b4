#include "calibrated/example_bottoms.h"

#include "calibrated/bottom.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

Material bottom(const char* name, double density_kg_m3, double sound_speed_m_s, double lambert_db,
                double slope_rms_deg) {
    const auto reflection =
        static_cast<float>(power_reflection(density_kg_m3, sound_speed_m_s, Water{}));
    return {name, density_kg_m3, sound_speed_m_s, reflection, lambert_db, slope_rms_deg};
}

}  // namespace

double scattering_strength(const Material& material, double /*frequency_hz*/, double sine) {
    const SinCos slope = sincos(radians(material.slope_rms_deg));
    return backscatter(material.lambert_db, material.reflection, slope.sin / slope.cos)
        .at(static_cast<float>(sine));
}

const std::array<Material, 3>& example_bottoms() {
    static const std::array<Material, 3> bottoms{bottom("mud", 1250, 1480, -34, 24),
                                                 bottom("sand", 1900, 1650, -27, 12),
                                                 bottom("rock", 2700, 5250, -10, 22)};
    return bottoms;
}

}  // namespace sonarsim
