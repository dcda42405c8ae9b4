#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"
#include "sonar/sonar.h"

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

/// Draws scene `number`: the shape (truss, net, stairs, pipes, leaves, wheel or ladder), its size,
/// thickness, orientation and distance, whether its bars share vertices, a floor behind it in half
/// of the scenes, and the sonar's angles. The kind of the sonar depends on the number: half of them
/// are imaging sonars. The same number gives the same scene.
Lattice draw_lattice(std::uint32_t number);

}  // namespace sonarsim::test
