#include "core/pose.h"

#include "core/elementary.h"

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

}  // namespace sonarsim
