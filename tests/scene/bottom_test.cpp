#include "input/scene/placing/bottom.h"

#include "scene/waves.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("scene") {
    TEST_CASE("bottom: the next surface below a point is that of all triangles one by one") {
        // Three layers of waves at UTM coordinates, and points above, between, below and outside.
        Surface layers;
        const Surface one = Waves::surface();
        const Eigen::Vector3d place(5e5, 6e6, -40.0);
        for (int k = 0; k < 3; ++k) {
            const auto first = static_cast<std::uint32_t>(layers.vertices.size());
            for (const Eigen::Vector3d& vertex : one.vertices)
                layers.vertices.push_back(vertex + place + Eigen::Vector3d(0.3 * k, 0.1, 1.5 * k));
            for (const auto& [a, b, c] : one.triangles)
                layers.triangles.push_back({first + a, first + b, first + c});
        }
        const Bottom bottom(layers);
        const Eigen::AlignedBox3d around = box_of(layers);
        int found = 0;
        for (int n = 0; n < 500; ++n) {
            const Eigen::Array3d share(std::fmod(0.6180 * n, 1.0), std::fmod(0.7549 * n, 1.0),
                                       std::fmod(0.5698 * n, 1.0));
            const Eigen::Vector3d point =
                around.min() + ((1.2 * share - 0.1) * around.sizes().array()).matrix();
            const double tolerance = n % 2 == 0 ? 0.0 : 0.2;
            std::optional<double> highest;
            for (const auto& [a, b, c] : layers.triangles) {
                const auto z = height_above(
                    {layers.vertices[a], layers.vertices[b], layers.vertices[c]}, point.head<2>());
                if (z && *z <= point.z() + tolerance && (!highest || *z > *highest)) highest = z;
            }
            CHECK(bottom.highest_below(point, tolerance) == highest);
            found += highest.has_value();
        }
        CHECK(found > 100);
        CHECK(found < 450);
    }

    TEST_CASE("bottom: thousands of triangles, each over all of it") {
        // In a grid of 438 x 438 cells they would lie in more than 2^32 cells together.
        constexpr int layers = 24000;
        Surface stack;
        for (std::uint32_t k = 0; k < layers; ++k) {
            const double z = -1.0 * k;
            for (const auto& [x, y] : {std::pair{-9.0, -9.0}, {27.0, -9.0}, {-9.0, 27.0}})
                stack.vertices.emplace_back(x, y, z);
            stack.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        }
        const Bottom bottom(stack);
        CHECK(bottom.highest_below({0.0, 0.0, -4000.5}, 0.0) == -4001.0);
        CHECK(bottom.highest({1.0, 2.0}) == 0.0);
        CHECK(!bottom.highest({20.0, 20.0}));
    }
}
