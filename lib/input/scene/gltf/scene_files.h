#pragma once

#include <memory>

#include "input/scene/placed_file.h"

namespace tinygltf {
class Model;
}

namespace sonarsim {

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
    struct Models;
    std::unique_ptr<Models> models_;
};

}  // namespace sonarsim
