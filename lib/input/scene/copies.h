#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "input/scene/scene.h"

namespace sonarsim {

/// The box around vertices, in their frame.
inline Eigen::AlignedBox3d box_of(std::span<const Eigen::Vector3f> vertices) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& vertex : vertices)
        box.extend(vertex.cast<double>());
    return box;
}

/// World boxes around the copies of shared meshes, in the order of Scene::copies. Each encloses the
/// rotated box of its mesh, so it may be up to sqrt(3) times as large along an axis as the copy
/// itself. Exact boxes would need every vertex of every copy.
std::vector<Eigen::AlignedBox3d> boxes_of_copies(const Scene& scene);

/// World boxes around the instances that stand still, by Scene::instances; empty for the others.
std::vector<Eigen::AlignedBox3d> boxes_of_instances(const Scene& scene);

/// Number of triangles of the scene, copies included.
std::size_t all_triangles(const Scene& scene);

/// The corners of a triangle of a placed copy, scene-local.
std::array<Eigen::Vector3f, 3> placed_corners(const Scene& scene, const MeshCopy& copy,
                                              std::size_t triangle);

}  // namespace sonarsim
