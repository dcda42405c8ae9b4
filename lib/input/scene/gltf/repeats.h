#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
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

/// The extent of a file's surface where it is placed.
struct SurfaceExtent {
    /// Box around the triangles that have an area, before they are rounded to floats.
    Eigen::AlignedBox3d box;
    double vertex_rounding_m = 0.0;  ///< as in Scene

    Eigen::Vector3d centre() const {
        return box.isEmpty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : box.center();
    }
};

/// InputError for vertices beyond the limits of coordinates.
SurfaceExtent find_extent(const OpenFile& file, ReadingLimit& limit);

/// The extent after a transform. Its box encloses the transformed box. InputError as above.
SurfaceExtent moved(const SurfaceExtent& extent, const Eigen::Affine3d& transform);

/// A file that the scene places several times, as if it were placed at the origin.
struct RepeatedFile {
    PlacedFile placed;
    OpenFile open;
    SurfaceExtent extent = {};
    std::optional<std::uint32_t> mesh = {};  ///< index into Scene::shared_meshes, once it is made
    std::string class_name = {};             ///< class of its copies, as `mesh`
};

/// The files of a scene that become shared meshes.
struct Repeats {
    std::deque<RepeatedFile> files;      ///< a deque, since `open` points to `placed`
    std::vector<RepeatedFile*> by_file;  ///< for each file of the scene; null: it is not shared
};

/// Finds the files that have names, do not move and are read more than once in the same way.
/// Returns none if they have at most `sharing_threshold` triangles together, counted as often as
/// they are placed. InputError if there are more triangles than 32 bits can number.
Repeats find_repeats(const std::vector<OpenFile>& open, std::size_t sharing_threshold,
                     ReadingLimit& limit);

/// Adds a copy of a repeated file where `file` is placed, after its mesh if it is the first.
void add_copy(RepeatedFile& repeated, const OpenFile& file, ReadingLimit& limit,
              MaterialNumbers& materials, Scene& scene);

}  // namespace sonarsim
