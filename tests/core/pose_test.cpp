#include "core/pose.h"

#include "support/test.h"

using Eigen::Vector3d;

namespace {

void check_near(const Vector3d& a, const Vector3d& b) {
    CAPTURE_ALL(a.transpose(), b.transpose());
    CHECK((a - b).norm() < 1e-14);
}

}  // namespace

TEST_CASE("pose: roll comes first, yaw last, about fixed axes (x forward, y left, z up)") {
    // The textbook matrix Rz(c) Ry(b) Rx(a), first column and last row: positive yaw turns the
    // bow to port, pitch turns it down, roll raises the port side.
    const double a = 0.3;
    const double b = -0.7;
    const double c = 2.1;
    const Eigen::Matrix3d R = rotation_from_rpy(a, b, c).toRotationMatrix();
    check_near(R.col(0), {std::cos(c) * std::cos(b), std::sin(c) * std::cos(b), -std::sin(b)});
    check_near(R.row(2).transpose(),
               {-std::sin(b), std::cos(b) * std::sin(a), std::cos(b) * std::cos(a)});
}

TEST_CASE("pose: the angles of a rotation are those that it is made of") {
    // Within a quarter turn of pitch the angles of a rotation are unique.
    for (const double roll : {-3.1, -1.0, 0.0, 0.4, 3.0}) {
        for (const double pitch : {-1.57, -0.7, 0.0, 1e-9, 1.2}) {
            for (const double yaw : {-3.1, -0.2, 0.0, 1.6, 3.14}) {
                CAPTURE_ALL(roll, pitch, yaw);
                const Rpy stated = rpy_from_rotation(rotation_from_rpy(roll, pitch, yaw));
                // At a pitch of -1.57 roll and yaw depend on a cosine of 8e-4.
                CHECK(std::abs(stated.roll - roll) < 1e-12);
                CHECK(std::abs(stated.pitch - pitch) < 1e-12);
                CHECK(std::abs(stated.yaw - yaw) < 1e-12);
            }
        }
    }
}

TEST_CASE("pose: a bow straight up or down has no roll, and comes back as it was") {
    for (const double pitch : {-0.5 * pi, 0.5 * pi}) {
        for (const double yaw : {-2.0, 0.0, 1.0}) {
            const Eigen::Quaterniond rotation = rotation_from_rpy(0.7, pitch, yaw);
            const Rpy stated = rpy_from_rotation(rotation);
            CHECK(stated.roll == 0.0);
            CHECK(std::abs(stated.pitch - pitch) < 1e-8);
            const Eigen::Matrix3d difference =
                rotation_from_rpy(stated.roll, stated.pitch, stated.yaw).toRotationMatrix() -
                rotation.toRotationMatrix();
            CHECK(difference.norm() < 1e-8);
        }
    }
}

TEST_CASE("pose: composition applies the right-hand transform first, and keeps unit length") {
    const Pose T_world_vehicle{rotation_from_rpy(0, 0, pi / 2), {10, 0, 0}};
    const Pose T_vehicle_sonar{rotation_from_rpy(0, pi / 2, 0), {1, 2, 3}};
    Pose pose = T_world_vehicle * T_vehicle_sonar;
    // The mount (1, 2, 3), turned by 90 deg to port, is (-2, 1, 3); the boresight points down.
    check_near(pose.translation, {8, 1, 3});
    check_near(pose.rotation * Vector3d::UnitX(), {0, 0, -1});
    check_near(pose.rotation * Vector3d::UnitY(), {-1, 0, 0});
    for (int i = 0; i < 10000; ++i)
        pose = pose * Pose{rotation_from_rpy(0.1, 0.2, 0.3), {1, 0, 0}};
    CHECK(std::abs(pose.rotation.norm() - 1.0) < 1e-15);
}
