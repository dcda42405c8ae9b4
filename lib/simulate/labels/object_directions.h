#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/pose.h"

namespace sonarsim {

/// A sphere around all of an object, world frame.
struct ObjectSphere {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius_m = 0.0;
    double area_m2 = 0.0;  ///< the object's surface; 0: not known
};

/// The directions in which some of these objects may lie, on a grid of cells over the y and z of
/// unit vectors in the sensor's frame. It may include too many directions, but misses no object.
class ObjectDirections {
  public:
    /// `surface` is a box around all surface, world; null or empty: not known.
    ObjectDirections(std::span<const ObjectSphere> spheres, const Eigen::AlignedBox3d* surface,
                     const Pose& T_world_sensor, double range_min_m, double range_max_m);

    /// For sound that bends: an object may lie in every direction.
    ObjectDirections();

    /// True if an object may lie in the direction of a unit vector, beyond a range.
    bool may_lie_behind(const Eigen::Vector3f& direction, float range_m) const {
        return far_m_[cell_of(direction.z()) * cells + cell_of(direction.y())] > range_m;
    }

    /// The square root of the least solid angle of the objects that may lie in a direction, rad. A
    /// convex body appears as large as a quarter of its surface, on average (Cauchy).
    float least_size(const Eigen::Vector3f& direction) const {
        return least_size_[cell_of(direction.z()) * cells + cell_of(direction.y())];
    }

    /// True if no surface lies in the direction of a unit vector beyond a range.
    bool is_empty_behind(const Eigen::Vector3f& direction, float range_m) const;

  private:
    static constexpr int cells = 128;  ///< along y and along z, from -1 to 1

    static std::size_t cell_of(float coordinate) {
        constexpr float half = 0.5F * cells;
        return static_cast<std::size_t>(std::clamp(half * coordinate + half, 0.0F, cells - 1.0F));
    }

    Eigen::AlignedBox3d from_sensor_;  ///< `surface`, relative to the sensor, axes of the world
    Eigen::Matrix3d rotation_;         ///< from the sensor's frame to the world's
    std::vector<float> far_m_;         ///< [z, y]: the greatest range of an object there; 0: none
    std::vector<float> least_size_;    ///< [z, y]
};

}  // namespace sonarsim
