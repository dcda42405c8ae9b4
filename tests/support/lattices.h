#pragma once

#include "simulate/sonar/sonar.h"
#include "support/test.h"

namespace sonarsim::test {

// Random structures of thin parts, which may stand between two columns or two rays.

/// A drawn scene with a sonar. The sonar's frame is the world frame.
struct Lattice {
    Scene scene;
    SonarConfig sonar;
};

/// Draws scene `number`: shape, size, thickness, place and the sonar's angles, welded bars and a
/// floor in half of the scenes each. The number decides the sonar; half are imaging.
Lattice draw_lattice(std::uint32_t number);

}  // namespace sonarsim::test
