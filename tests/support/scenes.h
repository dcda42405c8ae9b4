#pragma once

#include "core/elementary.h"
#include "support/shapes.h"

namespace sonarsim::test {

using namespace shapes;

/// A sea floor of waves about z = 0, |x|, |y| <= 30 m: swell of half a metre, ripples of 4 cm, two
/// materials. For comparisons with a reference.
inline Scene rough_floor() {
    Scene scene = empty_scene();
    const std::uint32_t materials[] = {add_material(scene, 0.2F), add_material(scene, 0.4F)};
    constexpr int n = 300;  // cells of 20 cm
    const auto point = [](int i, int j) -> Eigen::Vector3f {
        const double x = 0.2 * i - 30.0;
        const double y = 0.2 * j - 30.0;
        const double z = 0.3 * sincos(0.5 * x).sin + 0.2 * sincos(0.7 * y + 0.3 * x).cos +
                         0.04 * sincos(4.0 * x + y).sin + 0.02 * sincos(9.0 * y - 2.0 * x).sin;
        return Eigen::Vector3d(x, y, z).cast<float>();
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            add_quad(scene, point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1),
                     materials[(i / 40 + j / 40) % 2]);
        }
    }
    return scene;
}

}  // namespace sonarsim::test
