#include "visibility/auto_engine.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/units.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "visibility/make_engine.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;

namespace {

View auto_view(double relative_l1 = 0.03) {
    return {.azimuth_rad = radians(90.0),
            .elevation_rad = radians(20.0),
            .range_min_m = 1.0,
            .range_max_m = 25.0,
            .range_bins = 256,
            .beams = 128,
            .relative_l1 = relative_l1};
}

/// A smooth swell in triangles of 25 cm.
Scene swell() {
    Scene scene = test::empty_scene();
    test::add_floor(scene, 30.0F, 0.0F, test::add_material(scene, 0.3F), 240);
    for (Eigen::Vector3f& p : scene.vertices)
        p.z() = 0.4F * std::sin(0.25F * p.x()) * std::cos(0.2F * p.y());
    return scene;
}

/// A pose three metres above the floor that looks 15 degrees down.
Pose above_floor(double x) {
    Pose pose;
    pose.translation = {x, 0.0, 3.0};
    pose.rotation = Eigen::AngleAxisd(radians(15.0), Eigen::Vector3d::UnitY());
    return pose;
}

std::vector<Probe> probes_of(const View& view) {
    return {{view, above_floor(-20.0)}, {view, above_floor(-10.0)}};
}

bool same(const Samples& a, const Samples& b) {
    return a.items.size() == b.items.size() &&
           std::memcmp(a.items.data(), b.items.data(), a.items.size() * sizeof(Sample)) == 0;
}

}  // namespace

TEST_SUITE_BEGIN("auto engine");

TEST_CASE("rays are better if they meet the goal with less than half of the samples") {
    const View view = auto_view(0.03);
    CHECK(rays_are_better({.error = 0.03, .samples_share = 0.49}, view));
    CHECK_FALSE(rays_are_better({.error = 0.031, .samples_share = 0.1}, view));
    CHECK_FALSE(rays_are_better({.error = 0.01, .samples_share = 0.5}, view));
}

TEST_CASE("auto gives a view the finest goal and the most columns that its probes need") {
    Scene scene = test::empty_scene();
    test::add_floor(scene, 30.0F, 0.0F, test::add_material(scene, 0.3F), 10);
    const View view = auto_view();
    View other = view;
    other.beams = 64;
    std::vector<Probe> probes = probes_of(view);
    CHECK(required_rays(view, probes).goal == 0.0);
    probes[0].rays = {.goal = 0.03, .columns = 4};
    probes[1].rays = {.goal = 0.02, .columns = 1};
    probes.push_back({other, above_floor(0.0), {.goal = 0.001, .columns = 7}});
    CHECK(required_rays(view, probes).goal == 0.02);
    CHECK(required_rays(view, probes).columns == 4);
    View finer = view;
    finer.relative_l1 = 0.02;
    const Pose pose = above_floor(-15.0);
    const auto rays = make_rays_engine(scene, Caster(scene), {.columns = 4});
    const Samples seen = make_auto_engine(scene, {}, probes)->visible_surface(view, pose);
    CHECK(same(seen, rays->visible_surface(finer, pose)));
    CHECK_FALSE(same(seen, make_rays_engine(scene)->visible_surface(finer, pose)));
}

TEST_CASE("auto takes rays for a floor of small triangles, with the error of its probes" *
          doctest::skip(test::sanitized)) {
    const Scene scene = swell();
    REQUIRE(scene.triangles.size() > 20'000);
    const View view = auto_view();
    const std::vector<Probe> probes = probes_of(view);
    const auto slices = make_slices_engine(scene, {});
    const auto rays = make_rays_engine(scene);
    const auto chosen = make_auto_engine(scene, {}, probes);
    const RaysTrial trial = try_rays(scene, view, probes, *rays, *slices);
    REQUIRE(rays_are_better(trial, view));
    const Samples seen = chosen->visible_surface(view, above_floor(-15.0));
    View lenient = view;
    lenient.relative_l1 = trial.goal;
    CHECK(same(seen, rays->visible_surface(lenient, above_floor(-15.0))));
    CHECK(seen.estimated_l1 == trial.error);
    // Over so smooth a floor the rays are more accurate than their goal.
    CHECK(trial.goal > view.relative_l1);

    SUBCASE("and slices for a view without probes") {
        View other = view;
        other.beams = 64;
        CHECK(same(chosen->visible_surface(other, above_floor(-15.0)),
                   slices->visible_surface(other, above_floor(-15.0))));
    }
    SUBCASE("and slices if rays miss the goal") {
        const View strict = auto_view(0.003);
        const auto strict_choice = make_auto_engine(scene, {}, probes_of(strict));
        CHECK(same(strict_choice->visible_surface(strict, above_floor(-15.0)),
                   slices->visible_surface(strict, above_floor(-15.0))));
    }
}

TEST_CASE("auto takes slices for few triangles, and without probes") {
    const Scene scene = test::tank();
    REQUIRE(scene.triangles.size() < 20'000);
    const View view = auto_view();
    Pose pose;
    pose.translation = {0.0, 0.0, 1.5};
    const Samples by_slices = make_slices_engine(scene, {})->visible_surface(view, pose);
    const std::vector<Probe> probes{{view, pose}};
    CHECK(same(make_auto_engine(scene, {}, probes)->visible_surface(view, pose), by_slices));
    CHECK(same(make_auto_engine(scene, {}, {})->visible_surface(view, pose), by_slices));

    SUBCASE("but rays with multipath") {
        const std::vector<Probe> bouncing{{view, pose, {.goal = view.relative_l1}}};
        const Samples seen = make_auto_engine(scene, {}, bouncing)->visible_surface(view, pose);
        const Samples by_rays = make_rays_engine(scene)->visible_surface(view, pose);
        CHECK(same(seen, by_rays));
        CHECK(seen.estimated_l1 == by_rays.estimated_l1);
        CHECK(seen.estimated_l1 > 0.0);
    }
}

TEST_CASE("engine: slices with multipath gives a warning") {
    const View view = auto_view();
    const auto warning = [&](EngineKind type, bool multipath) {
        EngineSettings settings;
        settings.type = type;
        return accuracy_warning(settings, view, multipath);
    };
    CHECK(warning(EngineKind::slices, true).find("use engine: auto") != std::string::npos);
    CHECK(warning(EngineKind::slices, false).empty());
    CHECK(warning(EngineKind::automatic, true).empty());
    CHECK(warning(EngineKind::rays, true).empty());
}

TEST_SUITE_END();
