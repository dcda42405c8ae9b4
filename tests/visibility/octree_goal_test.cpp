#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "sonar/sonar.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "validation/image_error.h"
#include "validation/reference.h"
#include "visibility/octree/goal_check.h"
#include "visibility/octree/octree_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

// The octree follows accuracy.relative_l1, and warns if it misses it.

namespace {

Sonar sonar_for(double goal) {
    SonarConfig config = test::small_imaging();
    config.azimuth_bins = 128;
    return test::noise_free(config, goal);
}

struct Subject {
    const char* name;
    Scene scene;
    Pose pose;
};

std::array<Subject, 3> subjects() {
    Scene sphere = test::empty_scene();
    test::add_sphere(sphere, {4.0F, 0.2F, 0.0F}, 0.5F, test::add_material(sphere, 0.8F), 256);
    return {Subject{"sphere", sphere, Pose{}},
            Subject{"tank", test::tank(), {rotation_from_rpy(0.0, 0.26, -0.07), {-2.4, 0.4, 1.5}}},
            Subject{"rough floor",
                    test::rough_floor(),
                    {rotation_from_rpy(0.02, 0.35, 0.9), {-3.0, 2.0, 2.7}}}};
}

Pose pose_at(double x) {
    return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}};
}

}  // namespace

TEST_CASE("octree goal: images are within it, and smaller goals make smaller errors" *
          doctest::skip(test::sanitized)) {
    for (const Subject& subject : subjects()) {
        CAPTURE(subject.name);
        const Caster caster(subject.scene);
        const Reference truth = cast_reference(caster, subject.scene, sonar_for(0.03).settings.view,
                                               subject.pose, {0.002, 64.0, 40'000'000});
        double before = 1.0;
        for (const double goal : {0.1, 0.03, 0.01}) {
            CAPTURE(goal);
            const auto octree = make_octree_engine(subject.scene, {});
            const Ping ping =
                render_ping(sonar_for(goal), subject.scene, *octree, subject.pose, {1, 0});
            const double error = image_error(ping.intensity, truth.intensity).relative_l1;
            CHECK(error < goal);
            CHECK(error < 0.8 * before);
            before = error;
        }
    }
}

TEST_CASE("octree goal: a warning gives the error of leaves that are too large" *
          doctest::skip(test::sanitized)) {
    for (const Subject& subject : subjects()) {
        CAPTURE(subject.name);
        const Sonar sonar = sonar_for(0.01);
        const Caster caster(subject.scene);
        const Reference truth = cast_reference(caster, subject.scene, sonar.settings.view,
                                               subject.pose, {0.004, 64.0, 20'000'000});
        const auto octree = make_octree_engine(subject.scene, {.leaf_m = 0.08});
        const Ping ping = render_ping(sonar, subject.scene, *octree, subject.pose, {1, 0});
        const double error = image_error(ping.intensity, truth.intensity).relative_l1;
        const std::vector<std::string> warnings = octree->warnings();
        REQUIRE(warnings.size() == 1);
        CAPTURE(warnings[0]);
        CHECK(warnings[0].find("octree.leaf_m of ") != std::string::npos);
        const std::string mark = "off by about ";
        const double stated = std::stod(warnings[0].substr(warnings[0].find(mark) + mark.size()));
        CHECK(0.01 * stated > 0.7 * error);
        CHECK(0.01 * stated < 3.0 * error);
    }
}

TEST_CASE("octree goal: which pings are checked depends on their poses, not on their order") {
    const View view = sonar_for(0.03).settings.view;
    std::array<std::vector<std::string>, 2> stated;
    for (const int turn : {0, 1}) {
        GoalCheck check;
        for (int i = 0; i < 100; ++i) {
            const int k = turn == 0 ? i : 99 - i;
            if (const auto place = check.place_for(view, pose_at(k))) *place = 0.02 + 0.001 * k;
        }
        stated[turn] = check.warnings(0.0);
    }
    REQUIRE(stated[0].size() == 1);
    CHECK(stated[0] == stated[1]);
    CHECK(stated[0][0].find("of the 8 pings") != std::string::npos);
}

TEST_CASE("octree goal: a goal that is met is no matter for a warning") {
    const View view = sonar_for(0.03).settings.view;
    GoalCheck check;
    *check.place_for(view, pose_at(0.0)) = 0.029;
    CHECK(check.warnings(0.0).empty());
    CHECK(check.place_for(view, pose_at(0.0)) == nullptr);
    const auto place = check.place_for(view, pose_at(1.0));
    CHECK(check.warnings(0.0).empty());  // a ping that stored no error does not count
    *place = 0.041;
    REQUIRE(check.warnings(0.0).size() == 1);
    CHECK(check.warnings(0.0)[0].find("1 of the 2 pings") != std::string::npos);
    CHECK(check.warnings(0.0)[0].find("3.5 % on average and 4.1 % at worst") != std::string::npos);
}

TEST_SUITE_END();
