#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"
#include "sonar/sonar.h"
#include "support/draws.h"

namespace sonarsim::test {

// Random structures of thin parts, and sonars that look at them. Error estimates fail on such
// scenes first: a bar may stand between two slices or two rays, and a bin is as bright for a thin
// bar as for a wall.

/// A drawn scene with a sonar. The sonar's frame is the world frame.
struct Lattice {
    std::string shape;  ///< "truss", "net", ...
    Scene scene;
    SonarConfig sonar;
};

/// Known: trusses, nets, stairs, pipes, leaves, wheels and ladders. The estimates of the engines
/// were developed on such scenes. Kept aside: shapes that were used for judging alone.
enum class ShapeSet : std::uint8_t { known, kept_aside };

/// Draws scene `number`: the shape, its size, thickness, orientation and distance, whether its bars
/// share vertices, a floor behind it in half of the scenes, and the sonar's angles. The kind of the
/// sonar depends on the number: half of them are imaging sonars. The same number gives the same
/// scene.
Lattice draw_lattice(std::uint32_t number, ShapeSet set = ShapeSet::known);

/// Places a shape about the origin, some two units wide, before a sonar, as draw_lattice() does.
Lattice place_lattice(Draws& draws, std::uint32_t number, std::string shape, Scene scene);

}  // namespace sonarsim::test
