#include "run/preview/preview.h"
#include "support/test.h"

using Eigen::Vector2d;
using Eigen::Vector3d;

// The whole pictures: tests/golden.
namespace {

constexpr Rgb red{255, 0, 0};
constexpr Rgb green{0, 255, 0};
constexpr Rgb blue{0, 0, 255};
constexpr Rgb white{255, 255, 255};

/// A floor of 40 m at z = 0 with a box of 1 x 2 x 3 m on it, and a vehicle above the origin.
Assembly box_on_a_floor(double height_m, double yaw) {
    Assembly assembly;
    assembly.scene = floor_scene(20.0F, 0.0F, 0.5F);
    add_box(assembly.scene, {5.0F, 2.0F, 0.0F}, {6.0F, 4.0F, 3.0F}, 0);
    assembly.scene.bounds_min = {-20.0, -20.0, 0.0};
    assembly.scene.bounds_max = {20.0, 20.0, 3.0};
    assembly.trajectory = {{0.0, {rotation_from_rpy(0.0, 0.0, yaw), {0.0, 0.0, height_m}}}};
    return assembly;
}

/// A mark in a colour that nothing else has: the outline of a beam without width.
BeamOutline mark(const Vector3d& at, Rgb colour) {
    return {at, {at}, colour};
}

/// The pixels of a colour, as x + 1000 y.
std::vector<int> painted(const Picture& picture, Rgb colour) {
    std::vector<int> pixels;
    for (int k = 0; k < std::ssize(picture.pixels); ++k) {
        if (picture.pixels[k] == colour)
            pixels.push_back(k % picture.width + k / picture.width * 1000);
    }
    return pixels;
}

/// The one pixel that has the colour.
Vector2d place_of(const Picture& picture, Rgb colour) {
    const std::vector<int> places = painted(picture, colour);
    REQUIRE(places.size() == 1);
    return {places[0] % 1000, places[0] / 1000};
}

bool is_about(double pixels, double expected) {
    return std::fabs(pixels - expected) <= 1.0;  // either end is rounded down
}

}  // namespace

TEST_CASE("lines and dots: what lies outside is cut off, however far away it ends") {
    for (const double far : {100.0, 1e6, 1e12}) {
        Picture picture(10, 6, backdrop);
        draw_line(picture, {-far, 2.5}, {far, 2.5}, red);
        const std::vector<int> row = painted(picture, red);
        REQUIRE(row.size() == 10);
        CHECK(row.front() == 2000);
        CHECK(row.back() == 2009);
    }
    Picture picture(10, 6, backdrop);
    draw_line(picture, {-5.0, -1.0}, {15.0, -1.0}, red);
    draw_line(picture, {4.0, 6.0}, {4.0, 9.0}, red);
    draw_dot(picture, {std::numeric_limits<double>::quiet_NaN(), 4.0}, 1, red);
    draw_dot(picture, {1e300, 4.0}, 1, red);
    CHECK(painted(picture, red).empty());
    draw_line(picture, {3.5, 1.5}, {3.5, 1.5}, red);
    CHECK(painted(picture, red) == std::vector<int>{1003});
}

TEST_CASE("plan: x to the right, y up, one scale, and a line of 18 pixels where the bow points") {
    for (const double yaw : {0.0, 0.5 * pi}) {
        const Assembly assembly = box_on_a_floor(8.0, yaw);
        const auto engine = make_engine(assembly.scene, {});
        const Moment moment{
            assembly,
            *engine,
            0,
            {mark({-15, 0, 1}, red), mark({15, 0, 1}, green), mark({0, 15, 1}, blue)}};
        Picture plan = draw_plan(moment, 600, 420);
        const Vector2d west = place_of(plan, red);
        const Vector2d east = place_of(plan, green);
        const Vector2d north = place_of(plan, blue);
        CHECK(east.y() == west.y());
        const double px_per_m = (east.x() - west.x()) / 30.0;
        // 400 rows show the scene's 40 m.
        CHECK(px_per_m == approx(10.0).epsilon(0.02));
        CHECK(is_about(north.x() - west.x(), 15.0 * px_per_m));
        CHECK(is_about(east.y() - north.y(), 15.0 * px_per_m));
        const Vector2d here = 0.5 * (west + east);
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
        const Vector2d at = frame.pixel({x, y}) - Vector2d(frame.left, 0.0);
        return heights[static_cast<std::size_t>(at.y()) * frame.plot_width +
                       static_cast<std::size_t>(at.x())];
    };
    const std::vector<float> above = heights_below(*engine, {0.0, 0.0, 8.0}, frame);
    CHECK(height_at(above, 5.5, 3.0) == approx(3.0).epsilon(1e-5));
    for (const auto& [x, y] : {std::pair(-5.5, 3.0), std::pair(5.5, -3.0), std::pair(3.0, 5.5)})
        CHECK(std::fabs(height_at(above, x, y)) < 1e-5F);
    CHECK(std::isnan(height_at(above, 25.0, 0.0)));
    // At a height of 2 m the vehicle no longer sees the top.
    const std::vector<float> beside = heights_below(*engine, {0.0, 0.0, 2.0}, frame);
    CHECK(std::fabs(height_at(beside, 5.5, 3.0)) < 1e-5F);
}

TEST_CASE("objects in the plan: names lie within it and over no other name, the floor has none") {
    const PlaneFrame frame = plane_frame(600, 420, {-20.0, -20.0}, {20.0, 20.0});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-22.0, 22.0);
    std::vector<ObjectBox> objects{
        {"floor", {Vector3d(-20.0, -20.0, 0.0), Vector3d(20.0, 20.0, 0.0)}}};
    for (int k = 0; k < 60; ++k) {
        const double x = place(random);
        const double y = place(random);
        objects.push_back({"object number " + std::to_string(k),
                           {Vector3d(x, y, 0.0), Vector3d(x + 1.0, y + 1.0, 1.0)}});
    }
    Picture tile(600, 420, backdrop);
    const std::vector<Eigen::AlignedBox2d> names = draw_objects(tile, frame, objects);
    CHECK(names.size() == 20);
    for (std::size_t k = 0; k < names.size(); ++k) {
        CHECK(names[k].min().x() >= frame.left);
        CHECK(names[k].max().x() <= frame.left + frame.plot_width);
        CHECK(names[k].sizes().x() >= text_width("object number 1"));
        for (std::size_t other = 0; other < k; ++other)
            CHECK_FALSE(names[k].intersects(names[other]));
    }
}
