#include <doctest/doctest.h>

#include "support/approx.h"
#include "visibility/octree/leaf.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

namespace {

double area(const Triangle& triangle, const Cube& cube) {
    return moments(clip(triangle, cube), cube.min).area;
}

}  // namespace

TEST_CASE("octree clip: a triangle around the cube leaves the cube's section") {
    // The plane x + y + z = 3/2 cuts the unit cube in a regular hexagon of side 1/sqrt(2):
    // area 3 sqrt(3) / 4.
    const Triangle triangle{Eigen::Vector3d(6, -2, -2.5), Eigen::Vector3d(-2, 6, -2.5),
                            Eigen::Vector3d(-2.5, -2, 6)};
    CHECK(area(triangle, {Eigen::Vector3d::Zero(), 1.0}) == test::approx(1.299038106));
}

TEST_CASE("octree clip: a triangle inside stays whole, one outside vanishes") {
    const Triangle triangle{Eigen::Vector3d(0.1, 0.1, 0.5), Eigen::Vector3d(0.9, 0.1, 0.5),
                            Eigen::Vector3d(0.1, 0.9, 0.5)};
    CHECK(area(triangle, {Eigen::Vector3d::Zero(), 1.0}) == test::approx(0.32));
    CHECK(clip(triangle, {Eigen::Vector3d(0, 0, 1), 1.0}).corners == 0);
    CHECK(clip(triangle, {Eigen::Vector3d(5, 0, 0), 1.0}).corners == 0);
}

TEST_CASE("octree clip: a triangle in a face belongs to the cube above alone") {
    const Triangle triangle{Eigen::Vector3d(0.1, 0.1, 1.0), Eigen::Vector3d(0.9, 0.1, 1.0),
                            Eigen::Vector3d(0.1, 0.9, 1.0)};
    CHECK(area(triangle, {Eigen::Vector3d(0, 0, 0), 1.0}) == 0.0);
    CHECK(area(triangle, {Eigen::Vector3d(0, 0, 1), 1.0}) == test::approx(0.32));
}

TEST_CASE("octree clip: moments of the unit square") {
    // Two triangles about the corner: area 1, first moments 1/2, second moments 1/3 and 1/4.
    const Cube cube{Eigen::Vector3d(0, 0, -0.5), 1.0};
    const Triangle lower{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 0, 0),
                         Eigen::Vector3d(2, 2, 0)};
    const Triangle upper{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 0),
                         Eigen::Vector3d(0, 2, 0)};
    const Moments a = moments(clip(lower, cube), Eigen::Vector3d::Zero());
    const Moments b = moments(clip(upper, cube), Eigen::Vector3d::Zero());
    CHECK(a.area + b.area == test::approx(1.0));
    CHECK(a.first.x() + b.first.x() == test::approx(0.5));
    CHECK(a.second(0, 0) + b.second(0, 0) == test::approx(1.0 / 3.0));
    CHECK(a.second(0, 1) + b.second(0, 1) == test::approx(0.25));
}

TEST_SUITE_END();
