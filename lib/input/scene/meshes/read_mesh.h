#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace sonarsim {

/// True for the name of an .obj, .stl or .ply, unless the file holds a .glb.
bool is_mesh_file(const std::filesystem::path& path);

/// Reads an .obj, .stl or .ply of at most 2 GiB as tinygltf's structs, as if it were a glTF with
/// one node for each object or group and the materials that usemtl names; a node without a name
/// gets the name of the file. Polygons become triangles, points and lines primitives that have no
/// surface. No other file is read, not even an .mtl. Indices are not checked. InputError for a
/// faulty file, and without libassimp.
tinygltf::Model read_mesh(const std::filesystem::path& path);

}  // namespace sonarsim
