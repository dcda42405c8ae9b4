#include "scene/scene.h"

namespace sonarsim {

double power_reflection(double density_kg_m3, double sound_speed_m_s, const Water& water) {
    const double z = density_kg_m3 * sound_speed_m_s;
    const double z_w = water.density_kg_m3 * water.sound_speed_m_s;
    const double ratio = (z - z_w) / (z + z_w);
    return ratio * ratio;
}

}  // namespace sonarsim
