#include "input/trajectory/patterns.h"
#include "support/test.h"

namespace {

Trajectory poses_on_the_spot(std::initializer_list<double> times_s) {
    Trajectory poses;
    for (const double t_s : times_s)
        poses.push_back({t_s, {rotation_from_rpy(0.0, 0.0, 0.5 * pi), {1.0, 2.0, 3.0}}});
    return poses;
}

PhiloxKey wave_key(std::uint32_t seed) {
    return stream_key(seed, 0, 0, stream_named("wave motion"));
}

}  // namespace

TEST_CASE("Heave has the variance and the autocorrelation of the spectrum" *
          doctest::skip(sanitized)) {
    // Pierson-Moskowitz by energy shares u: r(lag) is s^2 times the integral over u from 0 to 1
    // of cos(2 pi lag / period (1.25 / -ln u)^(1/4)).
    constexpr int seeds = 4000;
    constexpr double deviation = 0.3;
    constexpr double period_s = 8.0;
    constexpr double lag_s = 3.0;
    MotionConfig motion{.period_s = period_s};
    motion.position_m[2] = deviation;
    double variance = 0.0;
    double product = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Trajectory poses = poses_on_the_spot({10.0, 21.0, 21.0 + lag_s});
        add_wave_motion(motion, wave_key(seed), poses);
        const double a = poses[1].T_world_vehicle.translation.z() - 3.0;
        const double b = poses[2].T_world_vehicle.translation.z() - 3.0;
        variance += a * a / seeds;
        product += a * b / seeds;
    }
    const double correlation = integral(0.0, 1.0, 100000, [](double share) {
        return std::cos(2.0 * pi * lag_s / period_s * std::pow(1.25 / -std::log(share), 0.25));
    });
    // Products of two normal numbers have a variance of at most 2 s^4.
    const double four_errors = 4.0 * std::sqrt(2.0 / seeds) * deviation * deviation;
    CHECK(std::fabs(variance - deviation * deviation) < four_errors);
    CHECK(std::fabs(product - correlation * deviation * deviation) < four_errors);
    CHECK(correlation < -0.2);
}

TEST_CASE("A vehicle moves in its own frame, and only where it was asked to") {
    MotionConfig motion;
    motion.position_m[0] = 0.5;  // surge
    motion.turn_deg[0] = 6.0;    // roll
    Trajectory poses = poses_on_the_spot({0.0, 1.0, 2.0});
    add_wave_motion(motion, wave_key(7), poses);
    for (const TimedPose& pose : poses) {
        // It heads along y.
        CHECK(pose.T_world_vehicle.translation.x() == approx(1.0));
        CHECK(std::fabs(pose.T_world_vehicle.translation.y() - 2.0) > 1e-3);
        CHECK(pose.T_world_vehicle.translation.z() == approx(3.0));
        const Rpy rpy = rpy_from_rotation(pose.T_world_vehicle.rotation);
        CHECK(std::fabs(rpy.roll) > 1e-4);
        CHECK(rpy.pitch == approx(0.0));
        CHECK(rpy.yaw == approx(0.5 * pi));
    }
}

TEST_CASE("Errors of single poses have their standard deviations, and no others move them") {
    const Trajectory truth{{0.0, {.translation = {0.0, 5.0, -10.0}}},
                           {10.0, {.translation = {10.0, 5.0, -10.0}}}};
    // The quantities y, z, pitch and yaw, less the truth.
    const auto errors_of = [&](const NavigationConfig& errors, std::uint32_t seed) {
        const PhiloxKey key = stream_key(seed, 0, 0, stream_named("navigation"));
        const TimedPose reported = reported_poses(truth, errors, key).back();
        CHECK(reported.t_s == 10.0);
        const Pose& pose = reported.T_world_vehicle;
        const Rpy rpy = rpy_from_rotation(pose.rotation);
        return Eigen::Array4d(pose.translation.y() - 5.0, pose.translation.z() + 10.0, rpy.pitch,
                              rpy.yaw);
    };
    const NavigationConfig single[] = {{.position_m = 2.0},
                                       {.depth_m = 0.1},
                                       {.tilt_deg = degrees(0.01)},
                                       {.heading_deg = degrees(0.02)},
                                       {}};
    for (int which = 0; which < 5; ++which) {
        constexpr int draws = 2000;
        Eigen::Array4d squares = Eigen::Array4d::Zero();
        for (std::uint32_t seed = 0; seed < draws; ++seed)
            squares += errors_of(single[which], seed).square() / draws;
        const Eigen::Array4d expected(2.0, 0.1, 0.01, 0.02);
        for (int k = 0; k < 4; ++k) {
            CAPTURE_ALL(which, k);
            // Four errors 1 / sqrt(2 n) of a deviation, 1.6 %: exceeded once in 16,000 runs.
            if (k == which) {
                CHECK(std::sqrt(squares[k]) == approx(expected[k]).epsilon(4.0 * 0.0158));
            } else {
                CHECK(std::sqrt(squares[k]) < 1e-12);
            }
        }
    }
}
