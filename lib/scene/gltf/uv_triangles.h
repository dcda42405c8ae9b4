#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "scene/gltf/scene_files.h"
#include "scene/maps/uv_mesh.h"
#include "scene/placed_file.h"

namespace sonarsim {

/// The parts of one image that the materials of a glTF file have, see Texture.
struct TextureParts {
    std::filesystem::path file = {};
    std::vector<std::optional<Eigen::AlignedBox2d>> of_material = {};  ///< empty: the whole image
};

/// The triangles of the instances whose element of `on` is not 0, with their TEXCOORD_0 converted
/// to coordinates of the whole image; instances are those of load_scene() for the same files.
/// Triangles whose material has no part of the image are left out. InputError for a primitive that
/// has no TEXCOORD_0 or another number of coordinates than of positions, and for a primitive of
/// another file than that of the parts.
std::vector<UvTriangle> uv_triangles(std::span<const PlacedFile> files, SceneFiles& models,
                                     std::span<const char> on, const TextureParts& parts);

}  // namespace sonarsim
