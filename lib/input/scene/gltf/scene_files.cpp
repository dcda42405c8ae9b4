#include "input/scene/gltf/scene_files.h"

#include <algorithm>
#include <list>
#include <optional>

#include "core/error.h"
#include "input/scene/gltf/file.h"
#include "input/scene/heightmap/height_model.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/seabed/bed_model.h"

namespace sonarsim {

namespace {

tinygltf::Model read_model(const PlacedFile& placed) {
    if (placed.seabed) return bed_model(*placed.seabed);
    if (placed.heightmap) return height_model(placed.file, *placed.heightmap);
    return is_mesh_file(placed.file) ? read_mesh(placed.file) : read_gltf(placed.file);
}

}  // namespace

struct SceneFiles::Models {
    struct Entry {
        std::filesystem::path file;
        std::optional<HeightmapRule> heightmap;
        std::shared_ptr<const Seabed> seabed;

        bool is_ground() const { return heightmap || seabed; }
        tinygltf::Model model;
    };
    std::list<Entry> entries;  // a list, so that references stay valid
};

SceneFiles::SceneFiles() : models_(std::make_unique<Models>()) {}
SceneFiles::~SceneFiles() = default;

const tinygltf::Model& SceneFiles::model(const PlacedFile& placed) {
    const auto known = std::ranges::find_if(models_->entries, [&](const Models::Entry& entry) {
        return entry.file.native() == placed.file.native() && entry.heightmap == placed.heightmap &&
               entry.seabed == placed.seabed;
    });
    if (known != models_->entries.end()) return known->model;
    try {
        Models::Entry entry{placed.file, placed.heightmap, placed.seabed, read_model(placed)};
        // Keep only one ground: grounds are large, and each variant of a mission may have its own.
        if (entry.is_ground()) {
            std::erase_if(models_->entries,
                          [](const Models::Entry& old) { return old.is_ground(); });
        }
        models_->entries.push_back(std::move(entry));
        return models_->entries.back().model;
    } catch (const InputError& error) {
        if (placed.place.file.empty()) throw;
        throw named_at(error, placed.place);
    }
}

}  // namespace sonarsim
