#include "input/trajectory/trajectory.h"
#include "support/test.h"

namespace {

Eigen::Quaterniond yawed(double yaw_deg) {
    return rotation_from_rpy(0, 0, radians(yaw_deg));
}

/// The distance between two attitudes, which is 0 for q and -q; accurate for tiny differences.
double distance(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}

Trajectory two_poses(double t0, double t1) {
    return {{t0, {yawed(0), {0, 0, 0}}}, {t1, {yawed(90), {10, -20, 30}}}};
}

}  // namespace

TEST_CASE("slerp turns at a constant rate on the shorter arc, whatever the signs") {
    for (const double turn : {1e-5, 1.0, 90.0, 170.0, 179.9}) {
        CAPTURE(turn);
        for (const double f : {0.0, 0.1, 0.5, 0.75, 1.0}) {
            CAPTURE(f);
            CHECK(distance(slerp(yawed(20), yawed(20 + turn), f), yawed(20 + f * turn)) < 1e-15);
        }
    }
    for (int i = 0; i < 200; ++i) {
        const Eigen::Quaterniond a = rotation_from_rpy(0.1 * i, -0.2 * i, 0.3 * i);
        const Eigen::Quaterniond b = rotation_from_rpy(0.5 * i, 0.7 * i, -1.1 * i);
        CHECK(distance(slerp(a, b, 0.37), a.slerp(0.37, b)) < 1e-14);
    }
}

TEST_CASE("interpolate: linear position, slerp attitude, own poses at own times") {
    const Trajectory poses = two_poses(100.0, 104.0);
    const TimedPose quarter = interpolate(poses, 101.0);
    CHECK(quarter.t_s == 101.0);
    CHECK(quarter.T_world_vehicle.translation == Eigen::Vector3d(2.5, -5, 7.5));
    CHECK(distance(quarter.T_world_vehicle.rotation, yawed(22.5)) < 1e-15);
    for (const TimedPose& pose : poses) {
        const TimedPose same = interpolate(poses, pose.t_s);
        CHECK(same.T_world_vehicle.translation == pose.T_world_vehicle.translation);
        CHECK(same.T_world_vehicle.rotation.coeffs() == pose.T_world_vehicle.rotation.coeffs());
    }
    CHECK_THROWS_WITH_AS(interpolate(poses, 99.5),
                         "no pose at 99.5 s: the trajectory runs from 100 to 104 s", InputError);
    CHECK_THROWS_AS(interpolate(poses, 104.5), InputError);
    CHECK_THROWS_AS(interpolate(poses, std::numeric_limits<double>::quiet_NaN()), InputError);
    CHECK_THROWS_WITH_AS(interpolate({}, 0.0), "a trajectory needs at least one pose", InputError);
}

TEST_CASE("resample: times are t0 + k / rate, and the last pose counts where it is on them") {
    const Trajectory poses = resample(two_poses(1.0, 101.0), 10.0);
    REQUIRE(poses.size() == 1001);
    for (std::size_t k = 0; k < poses.size(); ++k)
        CHECK(poses[k].t_s == 1.0 + static_cast<double>(k) / 10.0);  // not a running sum
    CHECK(poses[500].T_world_vehicle.translation == Eigen::Vector3d(5, -10, 15));
    CHECK(distance(poses[500].T_world_vehicle.rotation, yawed(45)) < 1e-15);
    // 0.3 is less than 3 * 0.1 in doubles. 2e-10 s before the grid is on it, 2e-9 not.
    const std::pair<double, std::size_t> counts[] = {
        {0.95, 10}, {1.0, 11}, {1.05, 11}, {0.3, 4}, {1.0 - 2e-10, 11}, {1.0 - 2e-9, 10}};
    for (const auto& poses_to : counts)
        CHECK(resample(two_poses(0.0, poses_to.first), 10.0).size() == poses_to.second);
    // Times since 1970 are only accurate to 2.4e-7 s; the last pose is that of the trajectory.
    const Trajectory epoch = resample(two_poses(1700000000.1, 1700000000.4), 10.0);
    REQUIRE(epoch.size() == 4);
    CHECK(epoch.back().T_world_vehicle.translation.isApprox(Eigen::Vector3d(10, -20, 30), 1e-6));
    const Trajectory one{{5.0, {yawed(30), {1, 2, 3}}}};
    REQUIRE(resample(one, 10.0).size() == 1);
    CHECK(resample(one, 10.0)[0].t_s == 5.0);
}

TEST_CASE("resample refuses rates that are too high, and too many poses") {
    CHECK_THROWS_WITH_AS(
        resample(two_poses(0.0, 1e6), 1000.0),
        "rate_hz of 1000 gives 1000000001 poses over 1e+06 s; at most 10000000 are allowed",
        InputError);
    // At 1.7e9 s neighbouring doubles are 2.4e-7 s apart: 10 MHz would repeat times.
    CHECK_THROWS_WITH_AS(resample(two_poses(1.7e9, 1.7e9 + 0.5), 1e7),
                         "rate_hz of 1e+07 is too high: near 1700000000.5 s neighbouring "
                         "poses would have equal times",
                         InputError);
    CHECK_THROWS_AS(resample({}, 1.0), InputError);
}
