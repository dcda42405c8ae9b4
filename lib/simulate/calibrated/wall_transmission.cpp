#include "simulate/calibrated/wall_transmission.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

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
