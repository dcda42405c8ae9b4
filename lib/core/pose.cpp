#include "core/pose.h"

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

Eigen::Quaterniond about(const Eigen::Vector3d& axis, double angle) {
    const SinCos half = sincos(0.5 * angle);
    return {half.cos, axis.x() * half.sin, axis.y() * half.sin, axis.z() * half.sin};
}

}  // namespace

Eigen::Quaterniond rotation_from_rpy(double roll, double pitch, double yaw) {
    return about(Eigen::Vector3d::UnitZ(), yaw) * about(Eigen::Vector3d::UnitY(), pitch) *
           about(Eigen::Vector3d::UnitX(), roll);
}

Eigen::Quaterniond rotation_from_degrees(const std::array<double, 3>& rpy_deg) {
    return rotation_from_rpy(radians(rpy_deg[0]), radians(rpy_deg[1]), radians(rpy_deg[2]));
}

Rpy rpy_from_rotation(const Eigen::Quaterniond& rotation) {
    constexpr double upright = 1e-9;  // below this cosine of pitch, roll is only rounding
    const Eigen::Matrix3d r = rotation.toRotationMatrix();
    const double cosine = std::hypot(r(2, 1), r(2, 2));
    const double pitch = arctan2(-r(2, 0), cosine);
    if (cosine < upright) return {0.0, pitch, arctan2(-r(0, 1), r(1, 1))};
    return {arctan2(r(2, 1), r(2, 2)), pitch, arctan2(r(1, 0), r(0, 0))};
}

}  // namespace sonarsim
