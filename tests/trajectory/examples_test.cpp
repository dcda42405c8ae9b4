#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "core/units.h"
#include "support/approx.h"
#include "trajectory/files.h"

using namespace sonarsim;
using Eigen::Vector3d;

namespace {

Trajectory example(const char* name) {
    return read_trajectory(std::filesystem::path(SONARSIM_SOURCE_DIR) / "trajectories" / name);
}

/// The depression of the bow below the horizon, degrees.
double dip(const TimedPose& pose) {
    return degrees(-std::asin((pose.T_world_vehicle.rotation * Vector3d::UnitX()).z()));
}

}  // namespace

TEST_SUITE("trajectory") {
    TEST_CASE("tank_loop.csv goes round in the near half, the bow down and on the far half") {
        const Trajectory poses = example("tank_loop.csv");
        REQUIRE(poses.size() == 90);
        for (std::size_t k = 0; k < poses.size(); ++k) {
            CAPTURE(k);
            const Pose& pose = poses[k].T_world_vehicle;
            CHECK(poses[k].t_s == test::approx(0.1 * static_cast<double>(k)));
            const Vector3d off = pose.translation - Vector3d(-1.5, 0, 1.5);
            CHECK(off.z() == 0.0);
            CHECK(off.norm() > 1.0 - 1e-6);
            CHECK(off.norm() < 1.5 + 1e-6);
            CHECK(dip(poses[k]) > 10.0 - 1e-5);
            CHECK(dip(poses[k]) < 20.0 + 1e-5);
            // The bow is on the line to (2.5, 0) as seen from above.
            const Vector3d bow = pose.rotation * Vector3d::UnitX();
            const Vector3d to_target = Vector3d(2.5, 0, 1.5) - pose.translation;
            CHECK(bow.x() > 0.0);
            CHECK(std::abs(bow.x() * to_target.y() - bow.y() * to_target.x()) < 1e-6);
        }
        // The loop is closed: the step from the last pose to the first is below 15 cm, like the
        // others.
        CHECK((poses.back().T_world_vehicle.translation - poses.front().T_world_vehicle.translation)
                  .norm() < 0.15);
    }

    TEST_CASE("seafloor_pass.csv is a straight line at 2 m/s over the middle") {
        const Trajectory poses = example("seafloor_pass.csv");
        REQUIRE(poses.size() == 120);
        for (std::size_t k = 0; k < poses.size(); ++k) {
            CAPTURE(k);
            // 119 steps of 0.4 m about the origin, so it starts at -23.8 m.
            const double x = -23.8 + 0.4 * static_cast<double>(k);
            CHECK((poses[k].T_world_vehicle.translation - Vector3d(x, 0, 8)).norm() < 1e-9);
            CHECK(poses[k].t_s == test::approx(0.2 * static_cast<double>(k)));
            CHECK(dip(poses[k]) == test::approx(15));
        }
    }
}
