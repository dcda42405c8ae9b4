#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// The vertices of a scene, and as few triangles as its flat faces need: what a plane is cut into
/// costs a slice time and shows nothing. Corners are taken out where the surface stays where it was
/// to within what floats about the scene's origin can tell, and no crack opens. Materials and
/// instances keep their borders. Only geometry is filled in, and `vertices` stays as it is. Nothing
/// for a scene in which next to nothing is flat.
std::optional<Scene> with_flat_faces_merged(const Scene& scene,
                                            const std::vector<std::uint32_t>& welded);

}  // namespace sonarsim
