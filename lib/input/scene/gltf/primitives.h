#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/scene/gltf/nodes.h"
#include "input/scene/placed_file.h"
#include "input/scene/scene.h"

namespace sonarsim {

inline bool has_area(const std::array<Eigen::Vector3d, 3>& p) {
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm() > 0.0;
}

inline bool is_finite(const std::array<Eigen::Vector3d, 3>& p) {
    return p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
}

/// Limits the work of reading a scene, since a small file can place a large mesh, or many small
/// ones, many times. InputError with `file` beyond the limit.
struct ReadingLimit {
    std::size_t work = 0;

    void add(std::size_t triangles, const Location& file);
};

/// The surface of one glTF primitive.
struct PrimitiveSurface {
    bool has_floats;                         ///< its positions are no integers
    std::vector<Eigen::Vector3d> positions;  ///< the vertices in the mesh's own axes
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads a primitive of triangles, a strip or a fan; nullopt for points and lines. Normalised
/// integers become numbers in [-1, 1]. InputError at `where`, or by `limit` for the whole `file`.
std::optional<PrimitiveSurface> read_surface(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const Location& where, const Location& file,
                                             ReadingLimit& limit);

/// A file of the scene with its placed meshes.
struct OpenFile {
    const PlacedFile* placed;
    const tinygltf::Model* model;
    std::vector<PlacedMesh> meshes;
    std::vector<std::uint32_t> instance_of_mesh;  ///< indices into Scene::instances
};

/// One primitive of one placed mesh.
struct PlacedPrimitive : PrimitiveSurface {
    const OpenFile& file;
    const PlacedMesh& mesh;
    std::uint32_t instance;
    int material;    ///< index into the glTF's materials; -1: none
    Location where;  ///< for error messages

    Location in_node() const { return {where.file + " of node '" + mesh.instance + "'"}; }
};

/// Calls `visit` with every primitive of a file. Returns the number that are no surfaces.
std::uint64_t for_each_primitive(const OpenFile& file, ReadingLimit& limit, const auto& visit) {
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
            auto surface = read_surface(*file.model, mesh.primitives[k], where, {path}, limit);
            if (!surface) {
                ++skipped;
                continue;
            }
            visit(PlacedPrimitive{std::move(*surface), file, file.meshes[i],
                                  file.instance_of_mesh[i], mesh.primitives[k].material, where});
        }
    }
    return skipped;
}

/// Adds triangles to a scene, a body, a shared mesh or a surface, and the vertices that they use.
template <class Mesh>
struct MeshBuilder {
    using Vertex = typename decltype(Mesh::vertices)::value_type;

    Mesh& mesh;
    SceneRejects& rejects;
    Eigen::Vector3d origin;
    // Index of a primitive's vertex in `mesh.vertices`, plus 1. Entries of earlier primitives do
    // not exceed the number of vertices before this one, so the entries need no clearing.
    std::vector<std::uint32_t> slots = {};

    /// Calls `note` for every triangle that is added.
    void add(const PlacedPrimitive& primitive, const auto& note) {
        const std::size_t first = mesh.vertices.size();
        slots.resize(std::max(slots.size(), primitive.positions.size()), 0);
        std::vector<Vertex> local;
        local.reserve(primitive.positions.size());
        for (const Eigen::Vector3d& position : primitive.positions)
            local.push_back((primitive.mesh.T_world_mesh * position - origin)
                                .template cast<typename Vertex::Scalar>());
        for (std::array<std::uint32_t, 3> vertices : primitive.triangles) {
            std::array<Eigen::Vector3d, 3> rounded;
            for (std::size_t k = 0; k < 3; ++k)
                rounded[k] = local[vertices[k]].template cast<double>();
            if (!is_finite(rounded)) {
                ++rejects.non_finite_triangles;
                continue;
            }
            if (!has_area(rounded)) {
                ++rejects.degenerate_triangles;
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& slot = slots[vertices[k]];
                if (slot <= first) {
                    mesh.vertices.push_back(local[vertices[k]]);
                    slot = static_cast<std::uint32_t>(mesh.vertices.size());
                }
                vertices[k] = slot - 1;
            }
            mesh.triangles.push_back(vertices);
            note();
        }
    }
};

/// The materials of a scene, numbered in the order in which they occur.
struct MaterialNumbers {
    bool nameless_allowed = false;     ///< a missing name becomes "(no material)"
    std::set<std::string> known = {};  ///< names in the CSV
    std::string fallback = {};         ///< replaces a missing or unknown name; "": no replacement
    std::map<std::string, std::uint32_t> numbers = {};
    std::vector<std::string> users = {};  ///< the first node that uses each material, for messages

    /// The index of a primitive's material in the scene, added at its first use. InputError: none.
    std::uint32_t of(const PlacedPrimitive& primitive, Scene& scene);
};

/// Gives an instance without a class the class of its materials. InputError if they differ.
void take_class_of_material(const PlacedPrimitive& primitive, std::string& class_name);

}  // namespace sonarsim
