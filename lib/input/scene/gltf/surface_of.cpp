#include "input/scene/gltf/surface_of.h"

#include <algorithm>

#include "input/scene/gltf/mesh_builder.h"
#include "input/scene/objects.h"

namespace sonarsim {

Surface surface_of(const PlacedFile& file, SceneFiles& models, std::span<const std::string> nodes) {
    PlacedFile by_node = file;
    by_node.name.clear();  // empty, so that meshes have the names of their nodes
    UniqueNames names;
    OpenFile open{&by_node, &models.model(file), {}, {}};
    open.meshes = place_meshes(*open.model, by_node, names);
    for (const std::string& pattern : nodes) {
        if (std::ranges::any_of(open.meshes, [&](const PlacedMesh& mesh) {
                return fits_pattern(pattern, mesh.instance);
            }))
            continue;
        throw InputError(file.place, "bottom: no node of " + file.file.string() + " fits '" +
                                         pattern +
                                         "'; `sonarsim inspect` lists the names of its nodes");
    }
    std::erase_if(open.meshes, [&](const PlacedMesh& mesh) {
        return !nodes.empty() && std::ranges::none_of(nodes, [&](const std::string& pattern) {
            return fits_pattern(pattern, mesh.instance);
        });
    });
    open.instance_of_mesh.assign(open.meshes.size(), 0);
    Surface surface;
    SceneRejects rejects;
    MeshBuilder<Surface> builder{surface, rejects, Eigen::Vector3d::Zero()};
    ReadingLimit limit;
    for_each_primitive(open, limit,
                       [&](const PlacedPrimitive& primitive) { builder.add(primitive, [] {}); });
    return surface;
}

}  // namespace sonarsim
