#pragma once

#include <filesystem>
#include <optional>

#include "scene/images/image.h"

namespace sonarsim {

/// Reads the world file next to an image, map.tfw, map.tifw or map.wld for map.tif; nullopt if
/// there is none. InputError if it has not six numbers, or for a grid that is turned.
std::optional<PixelGrid> read_world_file(const std::filesystem::path& image);

}  // namespace sonarsim
