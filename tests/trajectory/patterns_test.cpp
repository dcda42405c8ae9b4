#include "input/trajectory/patterns.h"

#include "support/test.h"

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Pose at(double x, double y, double z, double yaw_deg = 0.0) {
    return {rotation_from_rpy(0, 0, radians(yaw_deg)), {x, y, z}};
}

Vector3d position(const TimedPose& pose) {
    return pose.T_world_vehicle.translation;
}

/// The heading of the bow, degrees in (-180, 180].
double heading(const TimedPose& pose) {
    const Vector3d bow = pose.T_world_vehicle.rotation * Vector3d::UnitX();
    return degrees(std::atan2(bow.y(), bow.x()));
}

/// The angle from b to a, degrees in [-180, 180].
double turn(double a, double b) {
    return std::remainder(a - b, 360.0);
}

/// Lines of a survey over 40 x 20 m at 1 m/s and 10 Hz.
LawnmowerTrajectoryConfig survey(double heading_deg, double spacing) {
    return {{-10, 5}, {30, 25}, 3.0, heading_deg, spacing, 1.0, 10.0};
}

}  // namespace

TEST_CASE("waypoints: constant speed along straight legs, on which the attitude turns") {
    // 3-4-5: 5 m, then 10 m down; at 2 m/s they take 2.5 s and 5 s.
    const std::vector<Pose> points{at(0, 0, 0), at(3, 4, 0, 90), at(3, 4, -10, 90)};
    const Trajectory poses = follow_waypoints(points, 2.0, 4.0);
    REQUIRE(poses.size() == 31);
    CHECK(poses.front().t_s == 0.0);
    CHECK(poses.back().t_s == 7.5);
    CHECK((position(poses[5]) - Vector3d(1.5, 2, 0)).norm() < 1e-14);
    CHECK((position(poses[10]) - Vector3d(3, 4, 0)).norm() < 1e-14);
    CHECK((position(poses[20]) - Vector3d(3, 4, -5)).norm() < 1e-14);
    CHECK(heading(poses[5]) == approx(45));
    CHECK(heading(poses[20]) == approx(90));
    for (std::size_t k = 1; k < poses.size(); ++k)
        CHECK((position(poses[k]) - position(poses[k - 1])).norm() == approx(0.5).epsilon(1e-12));
    // At a rate of 0 the corners alone, at whatever time.
    CHECK(follow_waypoints(points, 2.0, 0.0)[1].t_s == 2.5);
}

TEST_CASE("waypoints: a leg without length, and more poses than memory holds") {
    const std::vector<Pose> on_the_spot{at(0, 0, 0), at(1, 0, 0), at(1, 0, 0, 90)};
    CHECK_THROWS_WITH_AS(follow_waypoints(on_the_spot, 1.0, 10.0),
                         "waypoint 3 has the position of the one before: a leg needs a length "
                         "(turn along a leg, not on the spot)",
                         InputError);
    // A kilometre at a micrometre a second is 1e9 s.
    CHECK_THROWS_AS(follow_waypoints(std::vector<Pose>{at(0, 0, 0), at(1000, 0, 0)}, 1e-6, 10.0),
                    InputError);
    CHECK_THROWS_WITH_AS(lawnmower(survey(0.0, 1e-9)),
                         "line_spacing_m of 1e-09 gives 2e+10 lines; at most 100000 are allowed",
                         InputError);
}

TEST_CASE("lawnmower along x: lines, steps, headings and times") {
    // 20 m across in strips of 5 m: lines at y = 7.5, 12.5, 17.5, 22.5, each 40 m long.
    // At 1 m/s: 4 * 40 s + 3 * 5 s = 175 s, at 10 Hz 1751 poses.
    const Trajectory poses = lawnmower(survey(0.0, 5.0));
    REQUIRE(poses.size() == 1751);
    CHECK((position(poses[0]) - Vector3d(-10, 7.5, 3)).norm() < 1e-12);
    CHECK((position(poses[400]) - Vector3d(30, 7.5, 3)).norm() < 1e-12);
    CHECK((position(poses[450]) - Vector3d(30, 12.5, 3)).norm() < 1e-12);
    CHECK((position(poses[850]) - Vector3d(-10, 12.5, 3)).norm() < 1e-12);
    CHECK((position(poses[1750]) - Vector3d(-10, 22.5, 3)).norm() < 1e-12);
    CHECK(heading(poses[200]) == approx(0).epsilon(1e-12));
    CHECK(std::abs(turn(heading(poses[650]), 180)) < 1e-9);
    CHECK(heading(poses[1100]) == approx(0).epsilon(1e-12));
    // Within a step the bow turns over +y: first to port, then to starboard.
    CHECK(heading(poses[410]) == approx(36));
    CHECK(heading(poses[860]) == approx(144));
}

TEST_CASE("lawnmower: without turns only the lines are left, at their times") {
    const Trajectory all = lawnmower(survey(0.0, 5.0));
    LawnmowerTrajectoryConfig plan = survey(0.0, 5.0);
    plan.turns = false;
    const Trajectory lines = lawnmower(plan);
    // Four lines of 40 m have 401 poses each; three turns of 5 m have 49 within.
    CHECK(all.size() == 1751);
    CHECK(lines.size() == 4 * 401);
    std::size_t k = 0;
    for (const TimedPose& pose : lines) {
        while (all[k].t_s < pose.t_s)
            ++k;
        CHECK(all[k].T_world_vehicle.translation == pose.T_world_vehicle.translation);
        CHECK(std::abs(std::remainder(heading(pose), 180.0)) < 1e-9);
    }
}

TEST_CASE("lawnmower: strips that do not fit exactly get equal margins") {
    // 20 m in strips of 8 m: three, at 15 - 8, 15 and 15 + 8.
    const Trajectory poses = lawnmower(survey(0.0, 8.0));
    CHECK(position(poses.front()).y() == approx(7));
    CHECK(position(poses.back()).y() == approx(23));
    // One strip wider than the area: one line along its middle, 40 s.
    const Trajectory one = lawnmower(survey(0.0, 50.0));
    CHECK(one.size() == 401);
    CHECK(position(one.front()).y() == approx(15));
    // 2.1 / 0.7, a little more than 3 in doubles, makes three lines of 10 m and two steps.
    const LawnmowerTrajectoryConfig exact{{0, 0}, {10, 2.1}, 0.0, 0.0, 0.7, 1.0, 10.0};
    CHECK(lawnmower(exact).size() == 315);
}

TEST_CASE("lawnmower: whatever the heading, swaths of the line spacing cover the rectangle" *
          doctest::skip(sanitized)) {
    for (const double degrees_of_line : {0.0, 17.0, 45.0, 90.0, 133.0, -60.0, 180.0, 359.0}) {
        CAPTURE(degrees_of_line);
        LawnmowerTrajectoryConfig plan = survey(degrees_of_line, 4.0);
        plan.rate_hz = 20.0;
        const Trajectory poses = lawnmower(plan);
        const Vector2d bow(std::cos(radians(degrees_of_line)), std::sin(radians(degrees_of_line)));
        const Vector2d port(-bow.y(), bow.x());
        std::size_t holes = 0;
        for (double x = plan.area_min_m[0]; x <= plan.area_max_m[0]; x += 1.0) {
            for (double y = plan.area_min_m[1]; y <= plan.area_max_m[1]; y += 1.0) {
                // Some pose on a line, of poses 5 cm apart, passes abeam within half the spacing.
                holes += std::none_of(poses.begin(), poses.end(), [&](const TimedPose& pose) {
                    const Vector2d off = Vector2d(x, y) - position(pose).head<2>();
                    const double yaw = turn(heading(pose), degrees_of_line);
                    const bool on_line =
                        std::abs(yaw) < 1e-6 || std::abs(std::abs(yaw) - 180) < 1e-6;
                    return on_line && std::abs(off.dot(bow)) < 0.051 &&
                           std::abs(off.dot(port)) < 2.0 + 1e-9;
                });
            }
        }
        CHECK(holes == 0);
        // Steps have the same speed. A pose that skips a corner comes a little nearer.
        for (std::size_t k = 1; k < poses.size(); ++k)
            REQUIRE((position(poses[k]) - position(poses[k - 1])).norm() < 0.05 + 1e-9);
    }
}

TEST_CASE("lawnmower: a rotated line is no longer than its strip needs") {
    // In one strip the line of a square at 45 degrees runs from corner to corner.
    LawnmowerTrajectoryConfig plan{{0, 0}, {10, 10}, 0.0, 45.0, 20.0, 1.0, 100.0};
    const double diagonal = 10.0 * std::sqrt(2.0);
    Trajectory poses = lawnmower(plan);
    CHECK(poses.back().t_s == approx(diagonal).epsilon(1e-3));
    CHECK((position(poses.front()) - Vector3d(0, 0, 0)).norm() < 1e-9);
    // In four strips of d / 4 the outer lines have d / 2, the inner ones d; two shift by d / 4.
    plan.line_spacing_m = diagonal / 4.0;
    const double step = plan.line_spacing_m;
    poses = lawnmower(plan);
    const double expected = 2 * (diagonal / 2) + 2 * diagonal + 2 * std::hypot(step, step) + step;
    CHECK(poses.back().t_s == approx(expected).epsilon(1e-3));
}
