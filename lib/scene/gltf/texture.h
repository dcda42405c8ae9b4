#pragma once

#include <filesystem>

#include "scene/images/read_image.h"

namespace sonarsim {

/// The image that the materials of a .gltf or .glb file name as baseColorTexture: embedded, or a
/// file in its folder or below. InputError as read_gltf() and read_image(), for a file whose
/// materials name none or several, and for one that is not laid by TEXCOORD_0 as it is.
Image read_texture(const std::filesystem::path& gltf);

}  // namespace sonarsim
