#pragma once

#include "input/scene/maps/ground_maps.h"
#include "support/test.h"

namespace sonarsim::test {

/// A square of n x n texels that is `size_m` long, around the origin. The first row is the north.
inline TexelFrame square_frame(int n, double size_m) {
    return {n, n, {-0.5 * size_m, 0.5 * size_m}, {n / size_m, -n / size_m}};
}

/// A map of factors by row and column.
inline StrengthTexels strengths(const TexelFrame& frame,
                                const std::function<float(int row, int column)>& factor) {
    StrengthTexels out{frame, {}};
    for (int row = 0; row < frame.height; ++row) {
        for (int column = 0; column < frame.width; ++column)
            out.factor.push_back(factor(row, column));
    }
    return out;
}

/// A map of choices among `materials` by row and column.
inline MaterialTexels material_texels(
    const TexelFrame& frame, std::vector<std::uint32_t> materials,
    const std::function<std::uint16_t(int row, int column)>& choice) {
    MaterialTexels out{frame, {}, std::move(materials)};
    for (int row = 0; row < frame.height; ++row) {
        for (int column = 0; column < frame.width; ++column)
            out.choice.push_back(choice(row, column));
    }
    return out;
}

/// Lays maps on all instances of a scene.
inline void lay(Scene& scene, std::optional<MaterialTexels> materials,
                std::optional<StrengthTexels> strengths) {
    scene.maps = std::make_shared<const GroundMaps>(std::move(materials), std::move(strengths),
                                                    std::vector<char>(scene.instances.size(), 1));
}

}  // namespace sonarsim::test
