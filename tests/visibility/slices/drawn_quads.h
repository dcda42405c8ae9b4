#pragma once

#include <Eigen/Core>
#include <random>

#include "visibility/slices/quad.h"

namespace sonarsim::test {

/// A random quadrilateral of a plane that faces the sonar. Its range is wide: no corner is moved.
inline Quad draw_quad(std::mt19937& random) {
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    // One after the other: compilers differ in the order of a function's arguments.
    const float tilt = between(-0.5F, 0.5F);
    const float rise = between(-0.5F, 0.5F);
    const Eigen::Vector3f normal = Eigen::Vector3f(-1.0F, tilt, rise).normalized();
    Quad quad{};
    quad.height_m = between(1.0F, 10.0F);
    quad.low = {between(-0.3F, 0.0F), between(-0.4F, -0.2F), between(0.0F, 0.2F)};
    quad.high = {quad.low.u + 0.01F, quad.low.low + between(-0.01F, 0.01F),
                 quad.low.high + between(-0.01F, 0.01F)};
    // On a plane -h q = n . (1, u, w).
    quad.u = quad.low.u;
    quad.w = quad.low.low;
    quad.q_u = -normal.y() / quad.height_m;
    quad.q_w = -normal.z() / quad.height_m;
    quad.q = -normal.x() / quad.height_m + quad.q_u * quad.u + quad.q_w * quad.w;
    quad.range_m = {0.0F, 1e4F};
    return quad;
}

}  // namespace sonarsim::test
