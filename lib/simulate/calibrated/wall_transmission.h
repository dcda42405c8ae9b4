#pragma once

#include <span>
#include <vector>

#include "input/scene/scene.h"

namespace sonarsim {

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

}  // namespace sonarsim
