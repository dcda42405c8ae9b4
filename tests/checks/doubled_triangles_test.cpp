#include "checks/doubled_triangles.h"

#include <doctest/doctest.h>

#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE_BEGIN("checks");

TEST_CASE("doubled triangles: those of two nodes, in whatever order their corners stand") {
    // A sphere of its own node, then two quads over it: each of two triangles. Nothing is doubled.
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.5F);
    add_sphere(scene, {9, 0, 0}, 1.0F, m, 16);
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, m);
    add_quad(scene, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, m);
    CHECK(find_doubled(scene).count == 0);
    // Every triangle of the first quad again in the node of the second, by vertices of its own and
    // turned round; and one of them once more in a third node.
    const auto again = [&](std::uint32_t t, std::uint32_t instance) {
        const std::array<std::uint32_t, 3> old = scene.triangles[t];
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const int k : {2, 0, 1}) {
            const Eigen::Vector3f at = scene.vertices[old[k]];
            scene.vertices.push_back(at);
        }
        scene.triangles.push_back({first, first + 1, first + 2});
        scene.triangle_material.push_back(m);
        scene.triangle_instance.push_back(instance);
    };
    const auto quad = static_cast<std::uint32_t>(scene.triangles.size()) - 4;
    const std::uint32_t one = scene.triangle_instance[quad];
    const std::uint32_t other = scene.triangle_instance[quad + 2];
    again(quad, other);
    again(quad + 1, other);
    again(quad, 0);
    // Triangles that are twice in one node do not count.
    again(quad + 2, other);
    const DoubledTriangles found = find_doubled(scene);
    CHECK(found.count == 3);
    CHECK(found.first_instance == one);
    CHECK(found.second_instance == other);
    CHECK(found.shared_triangles == 2);
}

TEST_SUITE_END();
