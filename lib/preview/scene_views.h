#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "preview/beams.h"
#include "product/picture.h"

namespace sonarsim {

/// A moment of a mission: where everything is at a pose of the trajectory.
struct Moment {
    const Assembly& assembly;
    std::uint32_t pose;
    std::vector<BeamOutline> beams;  ///< of the sonars, in their order
};

/// From above, north (y) up: the height of the highest surface that lies no higher than the
/// vehicle, dark where there is none, the trajectory, and the footprints of the sonars.
Picture draw_plan(const Moment& moment, int width, int height);

/// A cut along or across the vehicle's heading: the surface that the vertical plane through the
/// vehicle meets, and the beams of all sonars as they look from the side. The horizontal axis
/// counts from the vehicle, ahead or to starboard; the vertical one is world z.
Picture draw_section(const Moment& moment, bool across, int width, int height);

}  // namespace sonarsim
