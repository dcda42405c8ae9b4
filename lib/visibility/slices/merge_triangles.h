#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// Merges flat faces into as few triangles as they need, since several triangles in one plane cost
/// time and add nothing. Keeps the vertices of the scene. Corners are removed if the surface stays
/// in place to within the precision of floats about the scene's origin, and no crack opens. Borders
/// of materials and instances are kept. The result has only vertices, triangles, and the triangles'
/// materials and instances. Returns nullopt for a scene with hardly any flat faces.
std::optional<Scene> with_flat_faces_merged(const Scene& scene,
                                            const std::vector<std::uint32_t>& welded);

}  // namespace sonarsim
