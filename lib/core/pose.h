#pragma once

#include <Eigen/Geometry>
#include <array>

namespace sonarsim {

/// A rigid transform. A variable of this type is named T_to_from and takes coordinates of the
/// frame `from` to the frame `to`: p_to = rotation * p_from + translation (metres).
struct Pose {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< m
};

/// The same transform as a matrix.
inline Eigen::Affine3d affine(const Pose& pose) {
    return Eigen::Translation3d(pose.translation) * pose.rotation;
}

/// T_a_c = T_a_b * T_b_c.
inline Pose operator*(const Pose& T_a_b, const Pose& T_b_c) {
    return {(T_a_b.rotation * T_b_c.rotation).normalized(),
            T_a_b.rotation * T_b_c.translation + T_a_b.translation};
}

/// The rotation of roll about x, then pitch about y, then yaw about z, all about fixed axes:
/// R = Rz(yaw) Ry(pitch) Rx(roll). Radians. With z up, positive pitch turns the bow down.
Eigen::Quaterniond rotation_from_rpy(double roll, double pitch, double yaw);
/// The same in degrees.
Eigen::Quaterniond rotation_from_degrees(const std::array<double, 3>& rpy_deg);

/// Radians: roll and yaw in [-pi, pi], pitch in [-pi / 2, pi / 2].
struct Rpy {
    double roll = 0.0;
    double pitch = 0.0;
    double yaw = 0.0;
};

/// The angles of rotation_from_rpy(). If the bow points straight up or down, only the sum or the
/// difference of roll and yaw is defined; roll is 0 then.
Rpy rpy_from_rotation(const Eigen::Quaterniond& rotation);

}  // namespace sonarsim
