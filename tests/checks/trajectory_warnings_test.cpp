#include <doctest/doctest.h>

#include <cmath>

#include "checks/find_warnings.h"
#include "core/units.h"
#include "trajectory/files.h"

using namespace sonarsim;

namespace {

/// Ten poses on a circle about the origin, anticlockwise, whose headings are `turn` times what they
/// should be.
Trajectory circle(double turn) {
    Trajectory poses;
    for (int i = 0; i < 10; ++i) {
        const double angle = 0.2 * i;
        poses.push_back({static_cast<double>(i),
                         {rotation_from_rpy(0.0, 0.0, turn * (angle + 0.5 * pi)),
                          {10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0}}});
    }
    return poses;
}

std::vector<Warning> judge(const Trajectory& poses) {
    return trajectory_warnings(FileTrajectoryConfig{"poses.csv", 0.0}, poses);
}

/// The numbers of a file in the order w x y z, read as x y z w.
Trajectory misread(const Trajectory& poses) {
    Trajectory out = poses;
    for (TimedPose& pose : out) {
        const Eigen::Quaterniond q = pose.T_world_vehicle.rotation;
        pose.T_world_vehicle.rotation = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
    }
    return out;
}

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("trajectory warnings: headings along the way are sound") {
        CHECK(judge(circle(1.0)).empty());
    }

    TEST_CASE("trajectory warnings: angles in radians below a header of degrees") {
        // A heading of 1.57 to 3.37 degrees, 90 to 193 off the way; as radians it is right.
        const std::vector<Warning> warnings = judge(circle(pi / 180.0));
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].code == WarningCode::radians);
    }

    TEST_CASE("trajectory warnings: a quarter turn in radians, on the spot") {
        Trajectory still{{0.0, {rotation_from_rpy(0.0, 0.0, radians(1.5708)), {0.0, 0.0, 0.0}}}};
        CHECK(judge(still).size() == 1);
        still[0].T_world_vehicle.rotation = rotation_from_rpy(0.0, 0.0, radians(1.6));
        CHECK(judge(still).empty());
    }

    TEST_CASE("trajectory warnings: quaternions as w x y z") {
        // As x y z w a heading of psi becomes a roll of 180 degrees - psi: these lie on their backs
        // or sides until psi comes near to 180.
        const std::vector<Warning> warnings = judge(misread(circle(0.2)));
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].code == WarningCode::quaternion_order);
        // A vehicle that does lie on its nose is so in both orders.
        Trajectory down = circle(1.0);
        for (TimedPose& pose : down)
            pose.T_world_vehicle.rotation = rotation_from_rpy(0.0, radians(90.0), 0.0);
        CHECK(judge(down).empty());
    }
}
