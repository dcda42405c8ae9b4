#pragma once

#include <cstdint>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/product/picture.h"

namespace sonarsim {

/// Draws one picture of a mission at a pose of its trajectory: each sonar's image, and a plan of
/// scene, trajectory and footprints. `pose` must be less than the number of poses. Throws
/// std::runtime_error when memory does not suffice.
Picture draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose);

}  // namespace sonarsim
