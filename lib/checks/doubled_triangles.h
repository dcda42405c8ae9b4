#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/scene.h"

namespace sonarsim {

/// Triangles that stand in two instances at once, with the very same corners.
struct DoubledTriangles {
    std::size_t count = 0;
    /// The two that have the most of them in common; indices into Scene::instances.
    std::uint32_t one = 0, other = 0;
    std::size_t between_them = 0;
};

/// Looks for them among the scene's own triangles, in time that grows with their number. Bodies
/// that move and copies of shared meshes are left out.
DoubledTriangles find_doubled(const Scene& scene);

}  // namespace sonarsim
