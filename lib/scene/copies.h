#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// Boxes around the copies of shared meshes, world, by Scene::copies: around the turned box of the
/// mesh, and so up to sqrt(3) times as large along an axis as the copy itself. To look at every
/// vertex of every copy takes long where there are many.
std::vector<Eigen::AlignedBox3d> boxes_of_copies(const Scene& scene);

/// The triangles of all copies together.
std::size_t triangles_of_copies(const Scene& scene);

}  // namespace sonarsim
