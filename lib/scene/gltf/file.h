#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace sonarsim {

/// Reads the surfaces of a .gltf or .glb file into tinygltf's structs: nodes, meshes with their
/// POSITION, materials with name and extras, accessors and their bytes; nothing else. Types are
/// checked, indices and offsets are not. Reads at most 2 GiB, external buffers included. InputError
/// for a faulty file.
tinygltf::Model read_gltf(const std::filesystem::path& path);

}  // namespace sonarsim
