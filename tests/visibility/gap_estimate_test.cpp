#include "visibility/rays/gap_estimate.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "core/units.h"
#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

namespace {

constexpr float reach_m = 10.0F;

GapEstimate estimate(const CastRay& a, const CastRay& b, float reach = reach_m) {
    Sampling sampling;
    sampling.tolerance_m = 0.004F;
    return estimate_gap(a, b, sampling, reach);
}

CastRay nothing_at(double along) {
    const auto x = static_cast<float>(std::cos(along));
    return {{x, 0.0F, static_cast<float>(std::sin(along))}, static_cast<float>(along)};
}

/// A ray in the plane y = 0 at an elevation, and the plane through `point` that it met.
CastRay on_plane(double along, std::uint32_t facet, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal) {
    CastRay node = nothing_at(along);
    const Eigen::Vector3f n = normal.normalized();
    node.normal = n.dot(point) > 0.0F ? Eigen::Vector3f(-n) : n;
    node.height_m = -node.normal.dot(point);
    node.cosine = -node.normal.dot(node.direction);
    node.range_m = node.height_m / node.cosine;
    node.facet = facet;
    return node;
}

}  // namespace

TEST_CASE("two facets that share an edge are parted by it, be it a ridge or a valley") {
    // The edge lies at (5, 0, -1), at an elevation of atan(-1 / 5).
    const Eigen::Vector3f edge(5.0F, 0.0F, -1.0F);
    const double there = std::atan2(-1.0, 5.0);
    const Eigen::Vector3f steep(-1, 0, 1);
    const std::pair<Eigen::Vector3f, Eigen::Vector3f> bends[] = {
        {{0, 0, 1}, steep}, {steep, {0.1F, 0, 1}}};  // a valley, a ridge
    for (const double share : {0.1, 0.5, 0.8}) {
        const double below = there - share * radians(0.3);
        for (const auto& normals : bends) {
            const GapEstimate gap =
                estimate(on_plane(below, 1, edge, normals.first),
                         on_plane(below + radians(0.3), 2, edge, normals.second));
            CHECK(gap.continuous);
            CHECK(gap.border == test::approx(share).epsilon(0.01));
            CHECK(gap.bends);
            // The uncertainty is at most the range between the rays.
            CHECK(gap.range_uncertainty_m > 0.0F);
            CHECK(gap.range_uncertainty_m < 0.25F * 0.3F);
        }
    }
}

TEST_CASE("a surface that hides another one breaks off") {
    // A wall at 4 m in front of a floor that is met at 6 m.
    const CastRay wall = on_plane(-0.17, 1, {4, 0, 0}, {1, 0, 0});
    const CastRay floor = on_plane(-0.16, 2, {0, 0, -1}, {0, 0, 1});
    for (const bool swapped : {false, true}) {
        const GapEstimate gap = swapped ? estimate(floor, wall) : estimate(wall, floor);
        CHECK_FALSE(gap.continuous);
        // Behind the wall the floor extends from 1 / sin 0.16 to 1 / sin 0.17, the wall hardly.
        CHECK(gap.range_uncertainty_m ==
              test::approx(1.0 / std::sin(0.16) - 1.0 / std::sin(0.17)).epsilon(1e-3));
    }
    // Next to a ray that met nothing, the floor may extend to the reach.
    const GapEstimate horizon = estimate(floor, nothing_at(0.01));
    CHECK_FALSE(horizon.continuous);
    CHECK(horizon.range_uncertainty_m == test::approx(10.0 - 1.0 / std::sin(0.16)));
    // Out of reach nothing is uncertain.
    const CastRay far = on_plane(-0.09, 1, {0, 0, -1}, {0, 0, 1});
    CHECK(estimate(far, nothing_at(0.01)).range_uncertainty_m == 0.0F);
}

TEST_CASE("facets of one plane are parted half way, and nothing is uncertain") {
    // Planes that are equal but for rounding cross at a random place.
    const Eigen::Vector3f tilt(0.1F, 0.2F, 1.0F);
    for (int k = 0; k < 100; ++k) {
        const double along = radians(-20.0 + 0.1 * k);
        const GapEstimate gap =
            estimate(on_plane(along, 1, {5, 0, -1}, tilt),
                     on_plane(along + radians(0.3), 2, {5, 0, -1}, 3.0F * tilt), 100.0F);
        CHECK(gap.continuous);
        CHECK(gap.border == 0.5F);
        CHECK(gap.range_uncertainty_m < 1e-4F);
        CHECK_FALSE(gap.bends);
    }
}

TEST_SUITE_END();
