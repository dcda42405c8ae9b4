#pragma once

#include <filesystem>
#include <memory>

namespace tinygltf {
class Model;
}

namespace sonarsim {

/// glTF files that have been read, each once however often a scene uses it. Not thread-safe.
class SceneFiles {
  public:
    SceneFiles();
    ~SceneFiles();
    SceneFiles(const SceneFiles&) = delete;
    SceneFiles& operator=(const SceneFiles&) = delete;

    /// Reads the file on the first call. InputError as read_gltf. The reference stays valid.
    const tinygltf::Model& model(const std::filesystem::path& file);

  private:
    struct Models;
    std::unique_ptr<Models> models_;
};

}  // namespace sonarsim
