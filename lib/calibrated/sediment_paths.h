#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "trace/buried.h"

namespace sonarsim {

/// The sediments of the sea beds among these materials, by the numbers of the bottom model; other
/// materials have none. With k the wave number in the water, n the ratio of speeds and d the loss
/// parameter, two-way power falls by e^-(4 k d / n) for each metre: one way 8.686 k d / n dB/m.
std::vector<SedimentPath> sediment_paths(std::span<const Material> materials, const Water& water,
                                         double frequency_hz, double absorption_db_per_m);

}  // namespace sonarsim
