#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

namespace sonarsim {

/// Reads the surfaces of a .gltf or .glb file into tinygltf's structs: nodes, meshes with their
/// POSITION, materials with name and extras, accessors and their bytes; nothing else. Types are
/// checked, indices and offsets are not. Reads at most 2 GiB, external buffers included. InputError
/// for a faulty file.
tinygltf::Model read_gltf(const std::filesystem::path& path);

/// True if a URI of a glTF file names a file in its folder or below.
bool stays_below(const std::string& uri);

}  // namespace sonarsim
