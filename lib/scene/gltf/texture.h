#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "scene/images/read_image.h"

namespace sonarsim {

/// All images of a mesh, joined into one.
struct Texture {
    Image image;
    /// The part of the image that each material of the file has, in shares of its width and height;
    /// nothing for a material without an image. Empty: every material has the whole image.
    std::vector<std::optional<Eigen::AlignedBox2d>> part_of_material;
};

/// The images that the materials of a .gltf or .glb file name as baseColorTexture: embedded, or
/// files in its folder or below. Several stand side by side. InputError as read_gltf(),
/// ImageReader::read() and side_by_side(), for a file whose materials name none, and for one that
/// uses another TEXCOORD than TEXCOORD_0 or transforms it.
Texture read_texture(const std::filesystem::path& gltf, ImageReader& images);

}  // namespace sonarsim
