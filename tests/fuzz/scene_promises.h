#pragma once

#include <cstdint>
#include <cstdlib>

#include "scene/scene.h"

namespace sonarsim {

inline void require(bool holds) {
    if (!holds) std::abort();
}

/// Ends the process for a scene that breaks what scene.h says of it.
inline void check_promises(const Scene& scene) {
    require(scene.triangle_material.size() == scene.triangles.size());
    require(scene.triangle_instance.size() == scene.triangles.size());
    require(scene.origin.allFinite());
    for (const auto& vertex : scene.vertices)
        require(vertex.allFinite());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (const std::uint32_t vertex : scene.triangles[i]) {
            require(vertex < scene.vertices.size());
        }
        require(scene.triangle_material[i] < scene.materials.size());
        require(scene.triangle_instance[i] < scene.instances.size());
    }
}

}  // namespace sonarsim
