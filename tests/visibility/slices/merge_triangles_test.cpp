#include "visibility/slices/merge_triangles.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/approx.h"
#include "support/scenes.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

std::vector<std::uint32_t> each_by_itself(const Scene& scene) {
    std::vector<std::uint32_t> vertices(scene.vertices.size());
    std::iota(vertices.begin(), vertices.end(), 0U);
    return vertices;
}

double area_of(const Scene& scene) {
    double area = 0.0;
    for (const auto& [a, b, c] : scene.triangles) {
        const Eigen::Vector3f across =
            (scene.vertices[b] - scene.vertices[a]).cross(scene.vertices[c] - scene.vertices[a]);
        area += 0.5 * static_cast<double>(across.norm());
    }
    return area;
}

/// Two walls of n x n x 2 triangles each that meet at x = 0 at a right angle, or one flat wall.
/// They share the vertices of the line where they meet.
Scene two_walls(int n, bool flat, bool two_materials) {
    Scene scene = test::empty_scene();
    const std::uint32_t first = test::add_material(scene, 0.5F);
    const std::uint32_t second = two_materials ? test::add_material(scene, 0.2F) : first;
    for (int i = 0; i <= 2 * n; ++i) {
        for (int k = 0; k <= n; ++k) {
            const auto along = static_cast<float>(i - n) / static_cast<float>(n);
            const auto up = static_cast<float>(k) / static_cast<float>(n);
            scene.vertices.emplace_back(along, flat ? 0.0F : std::max(along, 0.0F), up);
        }
    }
    const auto vertex = [&](int i, int k) { return static_cast<std::uint32_t>(i * (n + 1) + k); };
    for (int i = 0; i < 2 * n; ++i) {
        for (int k = 0; k < n; ++k) {
            scene.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
            scene.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
            scene.triangle_material.insert(scene.triangle_material.end(), 2,
                                           i < n ? first : second);
            scene.triangle_instance.insert(scene.triangle_instance.end(), 2, 0);
        }
    }
    return scene;
}

}  // namespace

TEST_CASE("slices: flat faces keep their area and outline in a few triangles") {
    // A rectangle needs 2 triangles; two at an angle or of two materials need 4. The walls are 1 m
    // high and 2 m long if flat, else 1 m and sqrt(2) m.
    for (const bool flat : {true, false}) {
        for (const bool two_materials : {false, true}) {
            CAPTURE(flat);
            CAPTURE(two_materials);
            const Scene scene = two_walls(8, flat, two_materials);
            const auto result = with_flat_faces_merged(scene, each_by_itself(scene));
            REQUIRE(result);
            const Scene& merged = *result;
            CHECK(merged.triangles.size() == (flat && !two_materials ? 2 : 4));
            CHECK(area_of(merged) / (flat ? 2.0 : 1.0 + std::sqrt(2.0)) ==
                  test::approx(1.0).epsilon(1e-6));
            for (std::size_t i = 0; i < merged.triangles.size(); ++i) {
                // The triangles left of x = 0 have the first material.
                float middle = 0.0F;
                for (const std::uint32_t corner : merged.triangles[i])
                    middle += merged.vertices[corner].x();
                if (two_materials) CHECK(merged.triangle_material[i] == (middle < 0.0F ? 0 : 1));
            }
        }
    }
}

TEST_CASE("slices: a panel with two sides keeps both") {
    // Corners 0 to 3 of a unit square; 4 is its middle. The sides share the corners and are cut
    // along different diagonals, or one of them at the middle.
    for (const bool has_middle : {false, true}) {
        CAPTURE(has_middle);
        Scene scene = test::empty_scene();
        const std::uint32_t material = test::add_material(scene, 0.5F);
        scene.vertices = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {0, 0.5F, 0.5F}};
        scene.triangles = {{0, 1, 2}, {0, 2, 3}};
        if (has_middle)
            scene.triangles.insert(scene.triangles.end(),
                                   {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}});
        else
            scene.triangles.insert(scene.triangles.end(), {{1, 0, 3}, {1, 3, 2}});
        scene.triangle_material.assign(scene.triangles.size(), material);
        scene.triangle_instance.assign(scene.triangles.size(), 0);
        const auto merged = with_flat_faces_merged(scene, each_by_itself(scene));
        REQUIRE(merged);
        CHECK(merged->triangles.size() == 4);
        CHECK(area_of(*merged) == test::approx(2.0).epsilon(1e-6));
    }
}

TEST_CASE("slices: curved faces keep their triangles") {
    Scene scene = test::empty_scene();
    test::add_sphere(scene, {5, 0, 0}, 0.5F, test::add_material(scene, 0.5F), 16);
    const auto merged = with_flat_faces_merged(scene, each_by_itself(scene));
    CHECK((!merged || merged->triangles == scene.triangles));
}
