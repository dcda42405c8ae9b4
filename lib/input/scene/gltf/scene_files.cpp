#include "input/scene/gltf/scene_files.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
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

struct SceneFiles::Entry {
    std::filesystem::path file;
    std::optional<HeightmapRule> heightmap;
    std::shared_ptr<const Seabed> seabed;
    tinygltf::Model model;

    bool is_ground() const { return heightmap || seabed; }
};

SceneFiles::SceneFiles() = default;
SceneFiles::~SceneFiles() = default;

const tinygltf::Model& SceneFiles::model(const PlacedFile& placed) {
    const auto known = std::ranges::find_if(entries_, [&](const Entry& entry) {
        return entry.file.native() == placed.file.native() && entry.heightmap == placed.heightmap &&
               entry.seabed == placed.seabed;
    });
    if (known != entries_.end()) return known->model;
    Entry entry{placed.file, placed.heightmap, placed.seabed,
                read_named_at(placed.place, [&] { return read_model(placed); })};
    // Keep only one ground: grounds are large, and each variant of a mission may have its own.
    if (entry.is_ground())
        std::erase_if(entries_, [](const Entry& old) { return old.is_ground(); });
    return entries_.emplace_back(std::move(entry)).model;
}

}  // namespace sonarsim
