#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/scene.h"

namespace sonarsim {

/// Pairs of triangles of two instances that have exactly the same corners.
struct DoubledTriangles {
    std::size_t count = 0;
    /// The two instances that share most of these triangles; indices into Scene::instances.
    std::uint32_t first_instance = 0, second_instance = 0;
    std::size_t shared_triangles = 0;
};

/// Searches the scene's own triangles by sorting them. Bodies that move and copies of shared meshes
/// are left out.
DoubledTriangles find_doubled(const Scene& scene);

}  // namespace sonarsim
