#include "trajectory/navigation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "core/pose.h"
#include "core/units.h"
#include "support/approx.h"

namespace sonarsim {

namespace {

/// `length_m` along x in `duration_s`, in steps of a hundredth of both.
Trajectory straight_run(double length_m, double duration_s) {
    Trajectory poses;
    for (int i = 0; i <= 100; ++i) {
        const double share = i / 100.0;
        poses.push_back({share * duration_s, {.translation = {share * length_m, 5.0, -10.0}}});
    }
    return poses;
}

PhiloxKey navigation_key(std::uint32_t seed) {
    return stream_key(seed, 0, 0, stream_named("navigation"));
}

/// Standard deviation about 0 of 2000 draws.
template <class Draw>
double deviation_of(Draw draw) {
    constexpr int draws = 2000;
    double sum = 0.0;
    for (std::uint32_t seed = 0; seed < draws; ++seed) {
        const double x = draw(seed);
        sum += x * x / draws;
    }
    return std::sqrt(sum);
}

// A standard deviation of n normal draws has the relative standard error 1 / sqrt(2 n): 1.6 % of
// 2000. Four of them are exceeded once in 16,000 runs.
constexpr double four_errors = 4.0 * 0.0158;

}  // namespace

TEST_SUITE("navigation") {
    TEST_CASE("Without errors the truth is reported") {
        const Trajectory truth = straight_run(100.0, 50.0);
        const Trajectory reported = reported_poses(truth, {}, navigation_key(1));
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Pose& pose = reported[i].T_world_vehicle;
            CHECK(reported[i].t_s == truth[i].t_s);
            CHECK(pose.translation.isApprox(truth[i].T_world_vehicle.translation, 1e-12));
            CHECK(pose.rotation.isApprox(truth[i].T_world_vehicle.rotation, 1e-12));
        }
    }

    TEST_CASE("Errors of single poses have their standard deviations") {
        const Trajectory truth = straight_run(10.0, 10.0);
        const auto last = [&](const NavigationErrors& errors, std::uint32_t seed) {
            return reported_poses(truth, errors, navigation_key(seed)).back().T_world_vehicle;
        };
        const auto check = [](double found, double expected) {
            CHECK(found == test::approx(expected).epsilon(four_errors));
        };
        check(deviation_of([&](std::uint32_t seed) {
                  return last({.position_m = 2.0}, seed).translation.y() - 5.0;
              }),
              2.0);
        check(deviation_of([&](std::uint32_t seed) {
                  return last({.depth_m = 0.1}, seed).translation.z() + 10.0;
              }),
              0.1);
        check(deviation_of([&](std::uint32_t seed) {
                  return rpy_from_rotation(last({.tilt_rad = 0.01}, seed).rotation).pitch;
              }),
              0.01);
        check(deviation_of([&](std::uint32_t seed) {
                  return rpy_from_rotation(last({.heading_rad = 0.02}, seed).rotation).yaw;
              }),
              0.02);
    }
}

}  // namespace sonarsim
