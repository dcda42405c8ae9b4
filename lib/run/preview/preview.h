#pragma once

#include <cstdint>
#include <vector>

#include "input/mission/mission.h"
#include "run/preview/scene_views.h"
#include "simulate/assembly/assemble.h"
#include "simulate/product/picture.h"

namespace sonarsim {

/// A picture of a mission at a pose, and the edges of the views of its sonars there.
struct Preview {
    Picture picture;
    std::vector<BeamOutline> beams;
};

/// Draws one picture of a mission at a pose of its trajectory: each sonar's image, and a plan of
/// scene, trajectory and footprints. `pose` must be less than the number of poses. Throws
/// std::runtime_error when memory does not suffice.
Preview draw_preview(const Mission& mission, const Assembly& assembly, std::uint32_t pose);

}  // namespace sonarsim
