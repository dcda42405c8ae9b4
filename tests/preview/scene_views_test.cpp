#include "preview/scene_views.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"
#include "visibility/make_engine.h"

using namespace sonarsim;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr Rgb panel_red{255, 0, 0};
constexpr Rgb green{0, 255, 0};
constexpr Rgb blue{0, 0, 255};
constexpr Rgb white{255, 255, 255};

/// A floor of 40 m at z = 0 with a box of 1 x 2 x 3 m on it, and a vehicle above the origin.
Assembly box_on_a_floor(double height_m, double yaw) {
    Assembly assembly;
    assembly.scene = test::empty_scene();
    const std::uint32_t material = test::add_material(assembly.scene, 0.5F);
    test::add_floor(assembly.scene, 20.0F, 0.0F, material);
    test::add_box(assembly.scene, {5.0F, 2.0F, 0.0F}, {6.0F, 4.0F, 3.0F}, material);
    assembly.scene.bounds_min = {-20.0, -20.0, 0.0};
    assembly.scene.bounds_max = {20.0, 20.0, 3.0};
    assembly.trajectory = {{0.0, {rotation_from_rpy(0.0, 0.0, yaw), {0.0, 0.0, height_m}}}};
    return assembly;
}

/// A mark at a point of the world, in a colour that nothing else has: the outline of a beam that
/// has no width.
BeamOutline mark(const Vector3d& at, Rgb colour) {
    return {at, {at}, colour};
}

/// The one pixel that has the colour.
Vector2d place_of(Picture& picture, Rgb colour) {
    std::vector<Vector2d> places;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (picture.row(y)[x] == colour) places.emplace_back(x, y);
        }
    }
    REQUIRE(places.size() == 1);
    return places.front();
}

bool is_about(double pixels, double expected) {
    return std::fabs(pixels - expected) <= 1.0;  // either end is rounded down
}

}  // namespace

TEST_SUITE("preview") {
    TEST_CASE("plan: x to the right, y up, and the same scale both ways") {
        const Assembly assembly = box_on_a_floor(8.0, 0.0);
        const auto engine = make_engine(assembly.scene, {});
        const Moment moment{
            assembly,
            *engine,
            0,
            {mark({-15, 0, 1}, panel_red), mark({15, 0, 1}, green), mark({0, 15, 1}, blue)}};
        Picture plan = draw_plan(moment, 600, 420);
        const Vector2d west = place_of(plan, panel_red);
        const Vector2d east = place_of(plan, green);
        const Vector2d north = place_of(plan, blue);
        CHECK(east.y() == west.y());
        const double px_per_m = (east.x() - west.x()) / 30.0;
        // 400 rows show the scene's 40 m.
        CHECK(px_per_m == test::approx(10.0).epsilon(0.02));
        CHECK(is_about(north.x() - west.x(), 15.0 * px_per_m));
        CHECK(is_about(east.y() - north.y(), 15.0 * px_per_m));
    }

    TEST_CASE("plan: a line of 18 pixels points where the bow does") {
        for (const double yaw : {0.0, 0.5 * pi}) {
            const Assembly assembly = box_on_a_floor(8.0, yaw);
            const auto engine = make_engine(assembly.scene, {});
            const Moment moment{
                assembly, *engine, 0, {mark({-15, 0, 1}, panel_red), mark({15, 0, 1}, green)}};
            Picture plan = draw_plan(moment, 600, 420);
            const Vector2d here = 0.5 * (place_of(plan, panel_red) + place_of(plan, green));
            const int x = static_cast<int>(here.x());
            const int y = static_cast<int>(here.y());
            CHECK((plan.row(y)[x + 12] == white) == (yaw == 0.0));
            CHECK((plan.row(y - 12)[x] == white) == (yaw != 0.0));
            CHECK(plan.row(y)[x - 12] != white);
            CHECK(plan.row(y + 12)[x] != white);
        }
    }

    TEST_CASE("heights: the highest surface below the vehicle, where it is") {
        const Assembly assembly = box_on_a_floor(8.0, 0.0);
        const auto engine = make_engine(assembly.scene, {});
        const PlaneFrame frame = plane_frame(600, 220, {-20.0, -20.0}, {20.0, 20.0});
        const auto height_at = [&](const std::vector<float>& heights, double x, double y) {
            const Vector2d at = frame.pixel({x, y}) - Vector2d(frame.left, frame.top);
            return heights[static_cast<std::size_t>(at.y()) * frame.plot_width +
                           static_cast<std::size_t>(at.x())];
        };
        const std::vector<float> above = heights_below(*engine, {0.0, 0.0, 8.0}, frame);
        CHECK(height_at(above, 5.5, 3.0) == test::approx(3.0).epsilon(1e-5));
        for (const auto& [x, y] : {std::pair(-5.5, 3.0), std::pair(5.5, -3.0), std::pair(3.0, 5.5)})
            CHECK(std::fabs(height_at(above, x, y)) < 1e-5F);
        CHECK(std::isnan(height_at(above, 25.0, 0.0)));
        // At a height of 2 m the vehicle no longer sees the top.
        const std::vector<float> beside = heights_below(*engine, {0.0, 0.0, 2.0}, frame);
        CHECK(std::fabs(height_at(beside, 5.5, 3.0)) < 1e-5F);
    }
}
