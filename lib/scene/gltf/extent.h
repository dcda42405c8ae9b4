#pragma once

#include <Eigen/Geometry>

#include "scene/gltf/pieces.h"

namespace sonarsim {

/// How far the surface of a file reaches, where it is placed.
struct Extent {
    /// Around the triangles that have an area, before any rounding of ours.
    Eigen::AlignedBox3d box;
    double vertex_rounding_m = 0.0;  ///< as in Scene
};

/// InputError for vertices that lie too far out.
Extent find_extent(const OpenFile& file, ReadingLimit& limit);

/// The same somewhere else: a box around the moved box.
Extent moved(const Extent& extent, const Eigen::Affine3d& transform);

}  // namespace sonarsim
