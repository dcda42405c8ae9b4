#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "input/scene/gltf/nodes.h"
#include "input/scene/gltf/triangles.h"
#include "input/scene/placed_file.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// A file of the scene with its placed meshes.
struct OpenFile {
    const PlacedFile* placed;
    const tinygltf::Model* model;
    std::vector<PlacedMesh> meshes;
    std::vector<std::uint32_t> instance_of_mesh;  ///< indices into Scene::instances
};

/// One primitive of one placed mesh.
struct PlacedPrimitive {
    const OpenFile& file;
    const PlacedMesh& mesh;
    std::uint32_t instance;
    bool has_floats;                         ///< its positions are no integers
    std::vector<Eigen::Vector3d> positions;  ///< the vertices in the mesh's own axes
    std::vector<std::array<std::uint32_t, 3>> triangles;
    int material;    ///< index into the glTF's materials; -1: none
    Location where;  ///< for error messages

    Location in_node() const { return {where.file + " of node '" + mesh.instance + "'"}; }
};

/// Limits the work of reading a scene, since a small file can place a large mesh, or many small
/// ones, many times. InputError with `file` beyond the limit.
struct ReadingLimit {
    std::size_t work = 0;

    void add(const TriangleSource* source, const std::string& file);
};

/// Calls `visit` with every primitive of a file. Returns the number of primitives that are not
/// surfaces.
template <class Visit>
std::uint64_t for_each_primitive(const OpenFile& file, ReadingLimit& limit, const Visit& visit) {
    std::uint64_t skipped = 0;
    const std::string path = file.placed->file.string();
    for (std::size_t i = 0; i < file.meshes.size(); ++i) {
        const auto mesh_index = static_cast<std::size_t>(file.meshes[i].mesh);
        const tinygltf::Mesh& mesh = file.model->meshes[mesh_index];
        const std::string name =
            mesh.name.empty() ? std::to_string(mesh_index) : "'" + mesh.name + "'";
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            const std::set<int>& own = file.meshes[i].materials;
            if (!own.empty() && !own.contains(mesh.primitives[k].material)) continue;
            const Location where{fmt::format("{}: mesh {} primitive {}", path, name, k)};
            const auto source = open_triangles(*file.model, mesh.primitives[k], where);
            limit.add(source ? &*source : nullptr, path);
            if (!source) {
                ++skipped;
                continue;
            }
            const bool has_floats =
                source->positions.component->number == TINYGLTF_COMPONENT_TYPE_FLOAT;
            visit(PlacedPrimitive{file, file.meshes[i], file.instance_of_mesh[i], has_floats,
                                  read_positions(*source), read_triangles(*source, where),
                                  mesh.primitives[k].material, where});
        }
    }
    return skipped;
}

/// The materials of a scene, numbered in the order in which they occur.
struct MaterialNumbers {
    bool nameless_allowed = false;     ///< a missing name becomes "(no material)"
    std::set<std::string> known = {};  ///< names in the CSV
    std::string fallback = {};         ///< replaces a missing or unknown name; "": no replacement
    std::map<std::string, std::uint32_t> numbers = {};
    std::vector<std::string> users = {};  ///< the first node that uses each material, for messages

    /// The index of a primitive's material in the scene, which is added at its first use.
    /// InputError if it has none.
    std::uint32_t of(const PlacedPrimitive& primitive, Scene& scene);
};

/// Gives an instance without a class the class of its materials. InputError if they differ.
void take_class_of_material(const PlacedPrimitive& primitive, std::string& class_name);

}  // namespace sonarsim
