#include "scene/gltf/scene_files.h"

#include <map>

#include "core/named_at.h"
#include "scene/gltf/file.h"
#include "scene/meshes/read_mesh.h"

namespace sonarsim {

namespace {

tinygltf::Model read_model(const std::filesystem::path& path) {
    return is_mesh_file(path) ? read_mesh(path) : read_gltf(path);
}

}  // namespace

struct SceneFiles::Models {
    std::map<std::filesystem::path, tinygltf::Model> by_file;
};

SceneFiles::SceneFiles() : models_(std::make_unique<Models>()) {}
SceneFiles::~SceneFiles() = default;

const tinygltf::Model& SceneFiles::model(const PlacedFile& placed) {
    const auto known = models_->by_file.find(placed.file);
    if (known != models_->by_file.end()) return known->second;
    try {
        return models_->by_file.emplace(placed.file, read_model(placed.file)).first->second;
    } catch (const InputError& error) {
        if (placed.place.file.empty()) throw;
        throw named_at(error, placed.place);
    }
}

}  // namespace sonarsim
