#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "input/scene/gltf/primitives.h"
#include "input/scene/scene.h"

namespace sonarsim {

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
    template <class Note>
    void add(const PlacedPrimitive& primitive, const Note& note) {
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

/// Numbers the materials of a scene in the order in which they occur.
struct MaterialNumbers {
    std::map<std::string, std::uint32_t> numbers = {};
    std::vector<std::string> users = {};  ///< the first node that uses each material, for messages

    std::uint32_t of(const PlacedPrimitive& primitive, const MaterialRules& rules, Scene& scene) {
        const std::string name = material_name(primitive, rules);
        const auto number = static_cast<std::uint32_t>(scene.materials.size());
        const auto [entry, is_new] = numbers.emplace(name, number);
        if (is_new) {
            scene.materials.emplace_back();
            scene.materials.back().name = name;
            users.push_back(user_of(primitive));
        }
        return entry->second;
    }
};

}  // namespace sonarsim
