#include "visibility/slices/patch_corners.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "support/approx.h"
#include "visibility/slices/drawn_quads.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

std::array<Quad, lanes> draw_quads(std::mt19937& random, bool widens) {
    std::array<Quad, lanes> quads;
    std::ranges::generate(quads, [&] { return test::draw_quad(random, widens); });
    return quads;
}

struct Surface {
    double area_m2 = 0.0;
    double nearest_m = 1e9;
    double farthest_m = 0.0;
};

/// dA = X^3 du dw / h, summed over a fine grid of the picture plane, and the ranges there.
Surface surface_of(const Quad& quad) {
    constexpr int cells = 200;
    Surface out;
    for (int i = 0; i < cells; ++i) {
        const double s = (i + 0.5) / cells;
        const double width = (quad.high.u - quad.low.u) / cells;
        const double u = quad.low.u + s * (quad.high.u - quad.low.u);
        const double low = quad.low.low + s * (quad.high.low - quad.low.low);
        const double high = quad.low.high + s * (quad.high.high - quad.low.high);
        for (int k = 0; k < cells; ++k) {
            const double w = low + (k + 0.5) / cells * (high - low);
            const double q = quad.q + quad.q_u * (u - quad.u) + quad.q_w * (w - quad.w);
            const double range_m = std::sqrt(1.0 + u * u + w * w) / q;
            out.area_m2 += width * (high - low) / cells / (q * q * q * quad.height_m);
            out.nearest_m = std::min(out.nearest_m, range_m);
            out.farthest_m = std::max(out.farthest_m, range_m);
        }
    }
    return out;
}

}  // namespace

TEST_CASE("slices: eight quadrilaterals together have the corners of each alone") {
    std::mt19937 random(1);
    for (int run = 0; run < 50; ++run) {
        const std::array<Quad, lanes> quads = draw_quads(random, run % 2 == 0);
        const PatchCorners all = corners_of(quads);
        for (int lane = 0; lane < lanes; ++lane) {
            const QuadPoints alone = quads[lane].corners(quads[lane].low, quads[lane].high);
            for (int i = 0; i < 4; ++i) {
                CHECK((all.corners[i].at.at(lane) - alone.at(i)).norm() < 1e-5F * alone.range[i]);
                CHECK(all.corners[i].range[lane] == test::approx(alone.range[i]).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("slices: a parallelogram has the area and the range of its quadrilateral") {
    std::mt19937 random(2);
    for (int run = 0; run < 20; ++run) {
        std::array<Quad, lanes> quads = draw_quads(random, false);
        // Short along w: the ranges of a parallelogram are linear.
        for (Quad& quad : quads) {
            quad.low.high = quad.low.low + 0.1F;
            quad.high.high = quad.high.low + 0.1F;
        }
        const PatchCorners corners = corners_of(quads);
        const Parallelograms patches =
            fit_parallelograms(corners, Eigen::Matrix3f::Identity(), false);
        for (int lane = 0; lane < lanes; ++lane) {
            const Surface surface = surface_of(quads[lane]);
            CHECK(patches.area_m2[lane] == test::approx(surface.area_m2).epsilon(1e-3));
            // The range of a parallelogram that bends little, from its edges.
            const Eigen::Vector3f at = patches.position.at(lane);
            const float half_m = (std::fabs(at.dot(patches.edge_u.at(lane))) +
                                  std::fabs(at.dot(patches.edge_v.at(lane)))) /
                                 at.norm();
            CHECK(at.norm() - half_m == test::approx(surface.nearest_m).epsilon(5e-3));
            CHECK(at.norm() + half_m == test::approx(surface.farthest_m).epsilon(5e-3));
        }
    }
}

TEST_CASE("slices: a patch does not depend on those beside it") {
    std::mt19937 random(3);
    std::array<Quad, lanes> quads = draw_quads(random, true);
    quads[2] = Quad{};  // as in a batch that is not full
    quads[2].widens = true;
    quads[5] = quads[2];
    const PatchCorners before = corners_of(quads);
    const Parallelograms patches = fit_parallelograms(before, Eigen::Matrix3f::Identity(), true);
    std::ranges::reverse(quads);
    const PatchCorners after = corners_of(quads);
    const Parallelograms reversed = fit_parallelograms(after, Eigen::Matrix3f::Identity(), true);
    for (const int lane : {0, 1, 3, 4, 6, 7}) {
        const int other = lanes - 1 - lane;
        CHECK(patches.position.at(lane) == reversed.position.at(other));
        CHECK(patches.edge_u.at(lane) == reversed.edge_u.at(other));
        CHECK(patches.edge_v.at(lane) == reversed.edge_v.at(other));
        CHECK(patches.area_m2[lane] == reversed.area_m2[other]);
    }
}

TEST_SUITE_END();
