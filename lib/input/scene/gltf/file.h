#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace sonarsim {

/// Reads a .gltf or .glb file into tinygltf's structs, without its textures, animations, skins and
/// cameras. Sizes, indices and offsets are not checked, and a value of a wrong type is a default.
/// Reads at most 2 GiB, external buffers included. InputError for a faulty file.
tinygltf::Model read_gltf(const std::filesystem::path& path);

}  // namespace sonarsim
