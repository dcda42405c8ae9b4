#pragma once

#include <cstdint>

#include "assembly/assemble.h"
#include "mission/mission.h"
#include "product/picture.h"

namespace sonarsim {

/// One picture of a mission at a pose of its trajectory: what each sonar shows, a plan of scene,
/// trajectory and footprints, and cuts along and across the heading with the beams. `pose` is less
/// than the number of poses. std::runtime_error when memory does not suffice.
Picture draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose);

}  // namespace sonarsim
