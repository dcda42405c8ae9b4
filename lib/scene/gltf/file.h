#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace sonarsim {

/// The surfaces of a .gltf or .glb file as tinygltf's structs: nodes, meshes with their POSITION,
/// materials with name and extras, accessors and the bytes behind them; nothing else. Types are
/// right, but no index or offset has been checked. At most 2 GiB are read, external buffers
/// included. InputError for everything that is wrong.
tinygltf::Model read_gltf(const std::filesystem::path& path);

}  // namespace sonarsim
