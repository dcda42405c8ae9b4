#include "scene/gltf/scene_files.h"

#include <map>

#include "scene/gltf/file.h"

namespace sonarsim {

struct SceneFiles::Models {
    std::map<std::filesystem::path, tinygltf::Model> by_file;
};

SceneFiles::SceneFiles() : models_(std::make_unique<Models>()) {}
SceneFiles::~SceneFiles() = default;

const tinygltf::Model& SceneFiles::model(const std::filesystem::path& file) {
    const auto known = models_->by_file.find(file);
    if (known != models_->by_file.end()) return known->second;
    return models_->by_file.emplace(file, read_gltf(file)).first->second;
}

}  // namespace sonarsim
