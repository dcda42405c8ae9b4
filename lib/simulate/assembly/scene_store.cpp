#include "simulate/assembly/scene_store.h"

#include <algorithm>

#include "core/hash.h"

namespace sonarsim {

namespace {

bool have_same_surface(const PlacedFile& a, const PlacedFile& b) {
    return a.file == b.file && a.heightmap == b.heightmap && a.seabed == b.seabed &&
           a.unit_m == b.unit_m && a.z_up == b.z_up &&
           a.T_world_file.matrix() == b.T_world_file.matrix();
}

}  // namespace

const Surface& SceneStore::shape(const PlacedFile& file, const MeshConfig& mesh) {
    const auto known = std::ranges::find_if(shapes_, [&](const Shape& shape) {
        return shape.file.native() == file.file.native() && shape.mesh == mesh;
    });
    if (known != shapes_.end()) return known->surface;
    return shapes_.emplace_back(Shape{file.file, mesh, surface_of(file, *this)}).surface;
}

std::shared_ptr<const Bottom> SceneStore::bottom(const PlacedFile& placed,
                                                 const std::vector<std::string>& nodes) {
    if (bottom_ && nodes_ == nodes && have_same_surface(placed_, placed)) return bottom_;
    bottom_ = std::make_shared<const Bottom>(surface_of(placed, *this, nodes));
    placed_ = placed;
    nodes_ = nodes;
    return bottom_;
}

const std::string& SceneStore::sum_of(const std::filesystem::path& file) {
    std::string& sum = sums_[file];
    if (sum.empty()) sum = sha256_of_file(file);
    return sum;
}

}  // namespace sonarsim
