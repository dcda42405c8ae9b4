#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "input/scene/gltf/primitives.h"
#include "input/scene/scene.h"

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
