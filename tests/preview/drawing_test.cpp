#include "preview/drawing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/approx.h"

using namespace sonarsim;
using Eigen::Vector2d;

namespace {

constexpr Rgb red{255, 0, 0};

/// The pixels of a colour, as x + 1000 y.
std::vector<int> painted(Picture& picture, Rgb colour) {
    std::vector<int> pixels;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (picture.row(y)[x] == colour) pixels.push_back(x + 1000 * y);
        }
    }
    return pixels;
}

}  // namespace

TEST_SUITE("preview") {
    TEST_CASE(
        "plane frame: one scale for both axes, x to the right, y up, the wanted in the middle") {
        const PlaneFrame frame = plane_frame(400, 300, {-20.0, 5.0}, {20.0, 25.0});
        // 343 pixels for 40 m, 280 for 20 m: the width decides.
        REQUIRE(frame.plot_width == 400 - frame.left - 1);
        REQUIRE(frame.plot_height == 280);
        CHECK(frame.pixel_m == test::approx(40.0 / frame.plot_width));
        const Vector2d middle = frame.pixel({0.0, 15.0});
        CHECK(middle.x() == test::approx(frame.left + 0.5 * frame.plot_width));
        CHECK(middle.y() == test::approx(frame.top + 0.5 * frame.plot_height));
        // Three metres along x and two along y.
        const Vector2d moved = frame.pixel({3.0, 17.0}) - middle;
        CHECK(moved.x() == test::approx(3.0 / frame.pixel_m));
        CHECK(moved.y() == test::approx(-2.0 / frame.pixel_m));
        // Its ends are those of the plot.
        CHECK(frame.pixel({-20.0, 15.0}).x() == test::approx(frame.left));
        CHECK(frame.pixel({20.0, 15.0}).x() == test::approx(frame.left + frame.plot_width));
    }

    TEST_CASE("plane frame: the middle of every pixel comes back from its metres") {
        const PlaneFrame frame = plane_frame(200, 150, {1e5, -3.0}, {1e5 + 7.0, 90.0});
        for (const int row : {0, 1, 77, frame.plot_height - 1}) {
            for (const int column : {0, 50, frame.plot_width - 1}) {
                const Vector2d at = frame.pixel(frame.metres(column, row));
                CHECK(at.x() == test::approx(frame.left + column + 0.5));
                CHECK(at.y() == test::approx(frame.top + row + 0.5));
            }
        }
    }

    TEST_CASE("axes: the marks are at the pixels of their numbers") {
        // -20 to 20 m has about six marks, every 5 or 10 m, with 0 among them.
        const PlaneFrame frame = plane_frame(400, 300, {-20.0, -10.0}, {20.0, 10.0});
        Picture tile(400, 300, red);
        draw_axes(tile, frame);
        const int bottom = frame.top + frame.plot_height;
        const Vector2d zero = frame.pixel({0.0, 0.0});
        CHECK(tile.row(bottom + 2)[static_cast<int>(zero.x())] == ink);
        CHECK(tile.row(bottom + 2)[static_cast<int>(zero.x()) + 1] == backdrop);
        CHECK(tile.row(static_cast<int>(zero.y()))[frame.left - 3] == ink);
        CHECK(tile.row(static_cast<int>(zero.y()) + 1)[frame.left - 3] == backdrop);
        // The plot itself is left alone, and nothing else.
        CHECK(painted(tile, red).size() ==
              static_cast<std::size_t>(frame.plot_width) * frame.plot_height);
    }

    TEST_CASE("lines: what lies outside is cut off, however far away it ends") {
        for (const double far : {100.0, 1e6, 1e12}) {
            Picture picture(10, 6, backdrop);
            draw_line(picture, {-far, 2.5}, {far, 2.5}, red);
            std::vector<int> row;
            for (int x = 0; x < 10; ++x)
                row.push_back(x + 2000);
            CHECK(painted(picture, red) == row);
        }
        Picture picture(10, 6, backdrop);
        draw_line(picture, {-5.0, -1.0}, {15.0, -1.0}, red);
        draw_line(picture, {4.0, 6.0}, {4.0, 9.0}, red);
        CHECK(painted(picture, red).empty());
        draw_line(picture, {3.5, 1.5}, {3.5, 1.5}, red);
        CHECK(painted(picture, red) == std::vector<int>{1003});
    }

    TEST_CASE("lines: a share of the colour is a share of the way to it") {
        Picture picture(3, 1, Rgb{0, 0, 0});
        draw_line(picture, {0.5, 0.5}, {2.5, 0.5}, Rgb{200, 100, 0}, 0.5F);
        for (int x = 0; x < 3; ++x)
            CHECK(picture.row(0)[x] == Rgb{100, 50, 0});
    }

    TEST_CASE("dots: a square around the pixel of the point, none where there is no point") {
        Picture picture(9, 9, backdrop);
        draw_dot(picture, {4.9, 2.1}, 1, red);
        CHECK(painted(picture, red) ==
              std::vector<int>{1003, 1004, 1005, 2003, 2004, 2005, 3003, 3004, 3005});
        Picture empty(9, 9, backdrop);
        draw_dot(empty, {std::numeric_limits<double>::quiet_NaN(), 4.0}, 1, red);
        draw_dot(empty, {1e300, 4.0}, 1, red);
        CHECK(painted(empty, red).empty());
    }
}
