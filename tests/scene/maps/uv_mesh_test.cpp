#include "scene/maps/uv_mesh.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/draws.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("uv mesh") {
    TEST_CASE("texture coordinates of points: those of the triangles that they lie on") {
        // A sheet of 12 x 12 cells over z = sin x cos y, with random coordinates at its corners.
        // At a point with the weights w of a triangle's corners they are the sum of w uv.
        Draws draws(11);
        constexpr int n = 12;
        std::vector<Eigen::Vector3d> points;
        std::vector<Eigen::Vector2d> uv;
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                points.emplace_back(0.3 * i, 0.3 * j, std::sin(0.3 * i) * std::cos(0.3 * j));
                Eigen::Vector2d& next = uv.emplace_back();
                next.x() = static_cast<double>(draws.between(0, 1));
                next.y() = static_cast<double>(draws.between(0, 1));
            }
        }
        std::vector<UvTriangle> triangles;
        const auto add = [&](int a, int b, int c) {
            UvTriangle& next = triangles.emplace_back();
            const std::array<int, 3> corners{a, b, c};
            for (std::size_t k = 0; k < 3; ++k) {
                next.corners[k] = points[static_cast<std::size_t>(corners[k])];
                next.uv[k] = uv[static_cast<std::size_t>(corners[k])];
            }
            next.instance = 4;
        };
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const int a = j * (n + 1) + i;
                add(a, a + 1, a + n + 2);
                add(a, a + n + 2, a + n + 1);
            }
        }
        const UvMesh mesh(triangles);
        double worst = 0.0;
        double worst_slope = 0.0;
        for (int trial = 0; trial < 500; ++trial) {
            const auto& triangle = triangles[static_cast<std::size_t>(
                draws.whole(0, static_cast<int>(triangles.size()) - 1))];
            double x = static_cast<double>(draws.between(0, 1));
            double y = static_cast<double>(draws.between(0, 1));
            if (x + y > 1.0) {
                x = 1.0 - x;
                y = 1.0 - y;
            }
            const auto& [a, b, c] = triangle.corners;
            const Eigen::Vector3d point = a + x * (b - a) + y * (c - a);
            const Eigen::Vector2d expected = triangle.uv[0] +
                                             x * (triangle.uv[1] - triangle.uv[0]) +
                                             y * (triangle.uv[2] - triangle.uv[0]);
            const auto found = mesh.at(4, point);
            REQUIRE(found);
            worst = std::max(worst, (found->uv - expected).norm());
            const Eigen::Vector2d along = found->per_m * (b - a);
            // Points on a border have the slope of either side.
            if (x > 1e-3 && y > 1e-3 && x + y < 0.999) {
                worst_slope =
                    std::max(worst_slope, (along - (triangle.uv[1] - triangle.uv[0])).norm());
            }
        }
        CHECK(worst < 1e-9);
        CHECK(worst_slope < 1e-9);
        CHECK_FALSE(mesh.at(3, points[0]));
        CHECK_FALSE(UvMesh({}).at(0, points[0]));
    }
}
