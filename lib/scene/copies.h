#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// Boxes around the copies of shared meshes, world, by Scene::copies: around the turned box of the
/// mesh, and so up to sqrt(3) times as large along an axis as the copy itself. To look at every
/// vertex of every copy takes long where there are many.
std::vector<Eigen::AlignedBox3d> boxes_of_copies(const Scene& scene);

/// The triangles of all copies together.
std::size_t triangles_of_copies(const Scene& scene);

/// Those and the scene's own.
std::size_t all_triangles(const Scene& scene);

/// The corners of a triangle of a copy's mesh where the copy stands, scene-local.
std::array<Eigen::Vector3f, 3> placed_corners(const Scene& scene, const MeshCopy& copy,
                                              std::size_t triangle);

}  // namespace sonarsim
