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

    TEST_CASE("Scale, bias and drift bend a straight run by their closed forms") {
        constexpr double length_m = 1000.0;
        constexpr double duration_s = 500.0;
        const Trajectory truth = straight_run(length_m, duration_s);
        const auto end_error = [&](const NavigationErrors& errors, std::uint32_t seed) {
            const Trajectory reported = reported_poses(truth, errors, navigation_key(seed));
            return Eigen::Vector3d(reported.back().T_world_vehicle.translation -
                                   truth.back().T_world_vehicle.translation);
        };
        // A relative error s of the speed: s L ahead. A bias b: sin(b) L to port. A drift d: the
        // integral of v d t, d L T / 2.
        constexpr double small = 1e-3;
        const double ahead = deviation_of(
            [&](std::uint32_t seed) { return end_error({.speed_scale = small}, seed).x(); });
        const double by_bias = deviation_of(
            [&](std::uint32_t seed) { return end_error({.heading_bias_rad = small}, seed).y(); });
        const double by_drift = deviation_of([&](std::uint32_t seed) {
            return end_error({.heading_drift_rad_s = small / duration_s}, seed).y();
        });
        CHECK(ahead == test::approx(small * length_m).epsilon(four_errors));
        CHECK(by_bias == test::approx(small * length_m).epsilon(four_errors));
        CHECK(by_drift == test::approx(0.5 * small * length_m).epsilon(four_errors));
    }

    TEST_CASE("A constant bias turns a loop about its start, which it returns to") {
        Trajectory loop;
        for (int i = 0; i <= 360; ++i) {
            const double angle = radians(i);
            loop.push_back({0.1 * i,
                            {rotation_from_rpy(0.0, 0.0, angle),
                             {10.0 * std::sin(angle), -10.0 * std::cos(angle), -3.0}}});
        }
        const Trajectory reported =
            reported_poses(loop, {.heading_bias_rad = 0.2, .speed_scale = 0.1}, navigation_key(4));
        const Eigen::Vector3d start = loop.front().T_world_vehicle.translation;
        CHECK((reported.back().T_world_vehicle.translation - start).norm() < 1e-9);
        const Eigen::Vector3d chord = loop[90].T_world_vehicle.translation - start;
        const Eigen::Vector3d seen = reported[90].T_world_vehicle.translation - start;
        CHECK(std::fabs(seen.norm() / chord.norm() - 1.0) > 1e-3);
        const Rpy turned = rpy_from_rotation(reported[90].T_world_vehicle.rotation);
        const double bias = std::atan2(seen.y(), seen.x()) - std::atan2(chord.y(), chord.x());
        CHECK(turned.yaw - radians(90.0) == test::approx(bias));
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
