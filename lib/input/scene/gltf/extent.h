#pragma once

#include <Eigen/Geometry>

#include "input/scene/gltf/primitives.h"

namespace sonarsim {

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

}  // namespace sonarsim
