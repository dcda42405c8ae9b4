#include "simulate/labels/object_directions.h"

#include <cmath>
#include <limits>

namespace sonarsim {

ObjectDirections::ObjectDirections(std::span<const ObjectSphere> spheres,
                                   const Eigen::AlignedBox3d* surface, const Pose& T_world_sensor,
                                   double range_min_m, double range_max_m)
    : rotation_(T_world_sensor.rotation.toRotationMatrix()),
      far_m_(static_cast<std::size_t>(cells) * cells, 0.0F),
      least_size_(far_m_.size(), std::numeric_limits<float>::max()) {
    if (surface && !surface->isEmpty()) {
        // Vertices are floats relative to the scene's centre.
        constexpr double rounding_of_floats = 1e-7;
        const Eigen::Vector3d margin =
            Eigen::Vector3d::Constant(rounding_of_floats * surface->diagonal().norm());
        from_sensor_ = {surface->min() - T_world_sensor.translation - margin,
                        surface->max() - T_world_sensor.translation + margin};
    }
    const Eigen::Quaterniond to_sensor = T_world_sensor.rotation.conjugate();
    for (const ObjectSphere& sphere : spheres) {
        const Eigen::Vector3d centre = to_sensor * (sphere.centre - T_world_sensor.translation);
        const double distance_m = centre.norm();
        const double far_m = distance_m + sphere.radius_m;
        if (distance_m - sphere.radius_m > range_max_m || far_m < range_min_m) continue;
        // A line that meets the sphere has an angle of at most asin(radius / distance) with that to
        // its centre. Unit vectors at an angle a are 2 sin(a / 2) = sqrt(2 - 2 cos a) apart.
        const double sine = sphere.radius_m / distance_m;
        const bool is_inside = !(sine < 1.0);
        const double size = is_inside ? 0.0 : 0.5 * std::sqrt(sphere.area_m2) / distance_m;
        const double apart = is_inside ? 2.0 : std::sqrt(2.0 - 2.0 * std::sqrt(1.0 - sine * sine));
        const Eigen::Vector3d towards =
            is_inside ? Eigen::Vector3d::Zero() : Eigen::Vector3d(centre / distance_m);
        constexpr double rounding = 1e-6;  // also that of floats
        const auto cell_at = [](double at) { return cell_of(static_cast<float>(at)); };
        const std::size_t first_y = cell_at(towards.y() - apart - rounding);
        const std::size_t last_y = cell_at(towards.y() + apart + rounding);
        const std::size_t last_z = cell_at(towards.z() + apart + rounding);
        for (std::size_t z = cell_at(towards.z() - apart - rounding); z <= last_z; ++z) {
            for (std::size_t y = first_y; y <= last_y; ++y) {
                float& far = far_m_[z * cells + y];
                far = std::max(far, static_cast<float>(far_m));
                float& least = least_size_[z * cells + y];
                least = std::min(least, static_cast<float>(size));
            }
        }
    }
}

ObjectDirections::ObjectDirections()
    : rotation_(Eigen::Matrix3d::Identity()),
      far_m_(static_cast<std::size_t>(cells) * cells, std::numeric_limits<float>::infinity()),
      least_size_(far_m_.size(), 0.0F) {}

bool ObjectDirections::is_empty_behind(const Eigen::Vector3f& direction, float range_m) const {
    if (from_sensor_.isEmpty()) return false;
    // A line leaves the box for good at the nearest of the three planes that it crosses outwards.
    constexpr double step_behind = 1e-5;  // gap at which sight lines continue
    const Eigen::Vector3d point =
        range_m * (1.0 + step_behind) * (rotation_ * direction.cast<double>());
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_past = point[axis] > 0.0 ? point[axis] > from_sensor_.max()[axis]
                                               : point[axis] < from_sensor_.min()[axis];
        if (is_past) return true;
    }
    return false;
}

}  // namespace sonarsim
