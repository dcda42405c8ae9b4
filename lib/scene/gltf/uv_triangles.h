#pragma once

#include <span>
#include <vector>

#include "scene/gltf/scene_files.h"
#include "scene/maps/uv_mesh.h"
#include "scene/placed_file.h"

namespace sonarsim {

/// The triangles of the instances whose element of `on` is not 0, with their TEXCOORD_0; instances
/// are those of load_scene() for the same files. InputError for a primitive of them that has no
/// TEXCOORD_0, or another number of coordinates than of positions.
std::vector<UvTriangle> uv_triangles(std::span<const PlacedFile> files, SceneFiles& models,
                                     std::span<const char> on);

}  // namespace sonarsim
