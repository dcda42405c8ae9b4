#pragma once

#include <filesystem>
#include <memory>

namespace tinygltf {
class Model;
}

namespace sonarsim {

/// glTF files that have been read, each once however often a scene uses it. Not for several threads
/// at a time.
class SceneFiles {
  public:
    SceneFiles();
    ~SceneFiles();
    SceneFiles(const SceneFiles&) = delete;
    SceneFiles& operator=(const SceneFiles&) = delete;

    /// Reads the file unless it has been. InputError as read_gltf. Stays valid.
    const tinygltf::Model& model(const std::filesystem::path& file);

  private:
    struct Models;
    std::unique_ptr<Models> models_;
};

}  // namespace sonarsim
