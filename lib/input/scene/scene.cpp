#include "input/scene/scene.h"

#include <algorithm>

namespace sonarsim {

double power_reflection(double density_kg_m3, double sound_speed_m_s, const Water& water) {
    const double z = density_kg_m3 * sound_speed_m_s;
    const double z_w = water.density_kg_m3 * water.sound_speed_m_s;
    const double ratio = (z - z_w) / (z + z_w);
    return ratio * ratio;
}

bool has_coarse_vertices(const Scene& scene) {
    const double size = (scene.bounds_max - scene.bounds_min).maxCoeff();
    return scene.vertex_rounding_m > std::max(std::min(1e-3, 1e-4 * size), 1e-6 * size);
}

}  // namespace sonarsim
