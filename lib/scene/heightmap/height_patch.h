#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "scene/heightmap/height_field.h"
#include "scene/placed_file.h"
#include "scene/scene.h"

namespace tinygltf {
class Model;
}

namespace sonarsim {

/// The number of heights in a model of height_model().
std::size_t heights_in(const tinygltf::Model& model);

/// A map of heights, divided into square patches of `side` x `side` cells. scene() makes a scene of
/// some patches only. InputError as read_heights().
class HeightPatches {
  public:
    HeightPatches(const PlacedFile& map, int side, ImageReader& images);

    bool has_unknown() const { return has_unknown_; }

    /// The patches for which `is_needed` is true. It gets the centre, world, and the radius of a
    /// ball around each patch.
    std::vector<std::size_t> where(
        const std::function<bool(const Eigen::Vector3d& centre, double radius_m)>& is_needed) const;

    /// A scene of patches with vertices relative to `origin`, one material and one instance. Every
    /// n-th row and column is kept, as height_model() does; n divides `side`.
    Scene scene(const std::vector<std::size_t>& patches, int every,
                const Eigen::Vector3d& origin) const;

  private:
    struct Patch {
        int row = 0;  ///< row of its first height
        int column = 0;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double radius_m = 0.0;
    };

    Eigen::Vector3d world(int row, int column) const;

    HeightField field_;
    Eigen::Affine3d T_world_file_;
    int side_;
    bool has_unknown_;
    std::vector<Patch> patches_;
};

}  // namespace sonarsim
