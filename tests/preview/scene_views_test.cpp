#include "preview/scene_views.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/units.h"
#include "preview/scene_raster.h"
#include "support/approx.h"
#include "support/scenes.h"

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
        const Moment moment{
            assembly,
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
            const Moment moment{
                assembly, 0, {mark({-15, 0, 1}, panel_red), mark({15, 0, 1}, green)}};
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
        const PlaneFrame frame = plane_frame(600, 220, {-20.0, -20.0}, {20.0, 20.0});
        const auto height_at = [&](const std::vector<float>& heights, double x, double y) {
            const Vector2d at = frame.pixel({x, y}) - Vector2d(frame.left, frame.top);
            return heights[static_cast<std::size_t>(at.y()) * frame.plot_width +
                           static_cast<std::size_t>(at.x())];
        };
        const std::vector<float> above = heights_below(box_on_a_floor(8.0, 0.0), 0, frame);
        CHECK(height_at(above, 5.5, 3.0) == 3.0F);
        CHECK(height_at(above, -5.5, 3.0) == 0.0F);
        CHECK(height_at(above, 5.5, -3.0) == 0.0F);
        CHECK(height_at(above, 3.0, 5.5) == 0.0F);
        CHECK(std::isnan(height_at(above, 25.0, 0.0)));
        // At a height of 2 m the vehicle no longer sees the top, only the walls below it.
        const std::vector<float> beside = heights_below(box_on_a_floor(2.0, 0.0), 0, frame);
        CHECK(height_at(beside, 5.5, 3.0) == 0.0F);
        CHECK(height_at(beside, 5.0, 3.0) == 2.0F);
    }

    TEST_CASE("cuts: a plane meets what it passes, in its full length") {
        double floors = 0.0;
        double tops = 0.0;
        double walls = 0.0;
        const auto take = [&](const Vector3d& a, const Vector3d& b) {
            CHECK(std::fabs(a.y() - 3.0) < 1e-5);
            CHECK(std::fabs(b.y() - 3.0) < 1e-5);
            const double length = (b - a).norm();
            if (std::fabs(a.x() - b.x()) < 1e-5)
                walls += length;
            else
                (a.z() > 1.5 ? tops : floors) += length;
        };
        for_each_cut(box_on_a_floor(8.0, 0.0), 0, {0.0, 3.0, 8.0}, {1.0, 0.0}, take);
        CHECK(floors == test::approx(40.0 + 1.0));  // and the bottom of the box
        CHECK(tops == test::approx(1.0));
        CHECK(walls == test::approx(2.0 * 3.0));
    }

    TEST_CASE("sections: ahead or to starboard to the right, z up, the floor at its height") {
        // The bow points along y: ahead is y, starboard is x.
        const Assembly assembly = box_on_a_floor(8.0, 0.5 * pi);
        for (const bool across : {false, true}) {
            const auto at = [&](double off, double z) -> Vector3d {
                return across ? Vector3d(off, 0.0, z) : Vector3d(0.0, off, z);
            };
            const Moment moment{
                assembly,
                0,
                {mark(at(-10, 1), panel_red), mark(at(10, 1), green), mark(at(10, 6), blue)}};
            Picture section = draw_section(moment, across, 600, 420);
            const Vector2d left = place_of(section, panel_red);
            const Vector2d right = place_of(section, green);
            const Vector2d above = place_of(section, blue);
            CHECK(left.y() == right.y());
            const double px_per_m = (right.x() - left.x()) / 20.0;
            CHECK(px_per_m > 10.0);
            CHECK(above.x() == right.x());
            CHECK(is_about(right.y() - above.y(), 5.0 * px_per_m));
            // One metre below the marks is the floor, drawn in the colour of surfaces.
            const int x = static_cast<int>(0.5 * (left.x() + right.x()) + 3.0 * px_per_m);
            std::vector<int> rows;
            for (int y = static_cast<int>(left.y()); y < section.height - 20; ++y) {
                if (section.row(y)[x] == Rgb{205, 195, 170}) rows.push_back(y);
            }
            REQUIRE(rows.size() == 1);
            CHECK(is_about(rows[0] - left.y(), px_per_m));
        }
    }
}
