#include "visibility/slices/parallelogram.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

/// A random quadrilateral of a plane that faces the sonar. Its range is wide: no corner is moved.
Quad draw_quad(std::mt19937& random) {
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    // One after the other: compilers differ in the order of a function's arguments.
    const float tilt = between(-0.5F, 0.5F);
    const float rise = between(-0.5F, 0.5F);
    const Eigen::Vector3f normal = Eigen::Vector3f(-1.0F, tilt, rise).normalized();
    Quad quad{};
    quad.height_m = between(1.0F, 10.0F);
    quad.low = {between(-0.3F, 0.0F), between(-0.4F, -0.2F), between(0.0F, 0.2F)};
    quad.high = {quad.low.u + 0.01F, quad.low.low + between(-0.01F, 0.01F),
                 quad.low.high + between(-0.01F, 0.01F)};
    // On a plane -h q = n . (1, u, w).
    quad.u = quad.low.u;
    quad.w = quad.low.low;
    quad.q_u = -normal.y() / quad.height_m;
    quad.q_w = -normal.z() / quad.height_m;
    quad.q = -normal.x() / quad.height_m + quad.q_u * quad.u + quad.q_w * quad.w;
    quad.range_m = {0.0F, 1e4F};
    return quad;
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

TEST_CASE("slices: a parallelogram has the area and the range of its quadrilateral") {
    std::mt19937 random(2);
    for (int run = 0; run < 160; ++run) {
        Quad quad = draw_quad(random);
        // Short along w: the ranges of a parallelogram are linear.
        quad.low.high = quad.low.low + 0.1F;
        quad.high.high = quad.high.low + 0.1F;
        const Parallelogram patch =
            fit_parallelogram(quad, quad.corners(), Eigen::Matrix3f::Identity(), false);
        const Surface surface = surface_of(quad);
        CHECK(patch.area_m2 == test::approx(surface.area_m2).epsilon(1e-3));
        // The range of a parallelogram that bends little, from its edges.
        const float range_m = patch.position.norm();
        const float half_m = (std::fabs(patch.position.dot(patch.edge_u)) +
                              std::fabs(patch.position.dot(patch.edge_v))) /
                             range_m;
        CHECK(range_m - half_m == test::approx(surface.nearest_m).epsilon(5e-3));
        CHECK(range_m + half_m == test::approx(surface.farthest_m).epsilon(5e-3));
    }
}

TEST_SUITE_END();
