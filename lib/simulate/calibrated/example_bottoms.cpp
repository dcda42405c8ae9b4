#include "simulate/calibrated/example_bottoms.h"

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/seafloor_scattering.h"

namespace sonarsim {

namespace {

Material bottom(const char* name, double grain_phi) {
    Material material;
    material.name = name;
    material.grain_phi = grain_phi;
    return material;
}

}  // namespace

double scattering_strength(const Material& sea_bed, double frequency_hz, double sine) {
    const Water water;
    const SeafloorScattering scattering(sea_bed_of(sea_bed, water),
                                        2.0 * pi * frequency_hz / water.sound_speed_m_s);
    const double grazing_rad = arcsin(sine);
    return scattering.diffuse(grazing_rad) + scattering.specular(grazing_rad);
}

const std::array<Material, 3>& example_bottoms() {
    static const std::array<Material, 3> bottoms{bottom("mud", 8.0), bottom("sand", 1.5),
                                                 bottom("rock", -9.99)};
    return bottoms;
}

}  // namespace sonarsim
