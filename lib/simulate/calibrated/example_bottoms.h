#pragma once

#include <array>

#include "input/scene/scene.h"

namespace sonarsim {

/// The scattering cross-section per unit of area and solid angle at a grazing angle with this sine.
double scattering_strength(const Material& sea_bed, double frequency_hz, double sine);

/// Bottoms by which instruments are judged, as in scenes/materials.csv: mud, sand and rock.
const std::array<Material, 3>& example_bottoms();

inline const Material& example_sand() {
    return example_bottoms()[1];
}

}  // namespace sonarsim
