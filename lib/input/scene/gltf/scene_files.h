#pragma once

#include <filesystem>
#include <list>

#include "input/scene/placed_file.h"

namespace tinygltf {
class Model;
}

namespace sonarsim {

/// Reads a .gltf or .glb file into tinygltf's structs, without its textures, animations, skins and
/// cameras. Sizes, indices and offsets are not checked, and a value of a wrong type is a default.
/// Reads at most 2 GiB, external buffers included. InputError for a faulty file.
tinygltf::Model read_gltf(const std::filesystem::path& path);

/// Reads files of meshes, each only once, and keeps them. Not thread-safe.
class SceneFiles {
  public:
    SceneFiles();
    ~SceneFiles();
    SceneFiles(const SceneFiles&) = delete;
    SceneFiles& operator=(const SceneFiles&) = delete;

    /// Reads the file on the first call. InputError as read_gltf and read_mesh, with the place in
    /// the mission that names the file. The reference stays valid; a reference to a heightmap or a
    /// seabed only until another one, or another part of it, is read.
    const tinygltf::Model& model(const PlacedFile& placed);

  private:
    struct Entry;
    std::list<Entry> entries_;  ///< a list, so that references stay valid
};

}  // namespace sonarsim
