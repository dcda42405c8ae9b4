#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "calibrated/target_fixtures.h"
#include "support/approx.h"
#include "trace/target_shapes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    TEST_CASE("targets: bodies that move and copies of a mesh are sampled where they are") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const BallScene still({8.0, 0.3, 0.2}, 0.15, 32);
        const double expected = energy_by(with_targets(sonar, still.scene), still.scene,
                                          *engine_of(still.scene, EngineKind::rays));
        // The sphere about the origin of its own frame, with half of the radius for the copy.
        const BallScene ball({0.0, 0.0, 0.0}, 0.15, 32);
        const BallScene half({0.0, 0.0, 0.0}, 0.075, 32);
        const auto without_sphere = [&] {
            Scene scene = still.scene;
            const auto last = static_cast<std::ptrdiff_t>(scene.triangles.size() - 2);
            scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + last);
            scene.triangle_material.resize(2);
            scene.triangle_instance.erase(scene.triangle_instance.begin(),
                                          scene.triangle_instance.begin() + last);
            return scene;
        };
        const std::size_t count = ball.scene.triangles.size() - 2;
        const auto triangles = [&](const BallScene& of) {
            return std::vector(of.scene.triangles.begin(),
                               of.scene.triangles.begin() + static_cast<std::ptrdiff_t>(count));
        };
        const std::vector<std::uint32_t> materials(count, 0);

        Scene moving = without_sphere();
        moving.bodies.push_back({0, ball.scene.vertices, triangles(ball), materials});
        const auto engine = engine_of(moving, EngineKind::rays);
        const Pose there{rotation_from_rpy(0.0, 0.0, 0.7), {8.0, 0.3, 0.2}};
        CHECK(energy_by(with_targets(sonar, moving), moving, *engine->at({&there, 1})) ==
              test::approx(expected).epsilon(0.01));

        Scene copied = without_sphere();
        copied.shared_meshes.push_back({half.scene.vertices, triangles(half), materials});
        MeshCopy copy{.mesh = 0, .instance = 0};
        copy.T_world_mesh = Eigen::Translation3d(8.0, 0.3, 0.2) * Eigen::Scaling(2.0);
        copied.copies.push_back(copy);
        CHECK(
            energy_by(with_targets(sonar, copied), copied, *engine_of(copied, EngineKind::rays)) ==
            test::approx(expected).epsilon(0.01));
    }

    TEST_CASE("targets: a cube keeps its faces, a sphere's mesh is a sphere") {
        Scene scene = empty_scene();
        const std::uint32_t rock = add_material(scene, 0.4F);
        add_box(scene, {-1, -1, -1}, {1, 1, 1}, rock);
        const TargetShape cube =
            target_shape({scene.vertices, scene.triangles, scene.triangle_material});
        CHECK(cube.triangles.size() == 12);
        CHECK(cube.curvature_m == 0.0F);
        for (const TargetTriangle& triangle : cube.triangles) {
            for (const Eigen::Vector3f& normal : triangle.normals)
                CHECK((normal - triangle.normal).norm() < 1e-6F);
        }

        for (const int sides : {16, 20, 40}) {
            Scene round = empty_scene();
            add_sphere(round, {3, 4, 5}, 2.0F, add_material(round, 0.4F), sides);
            // The same triangles once more, seen from the other side.
            std::vector<std::array<std::uint32_t, 3>> twice = round.triangles;
            for (const auto& [a, b, c] : round.triangles)
                twice.push_back({a, c, b});
            const TargetShape sphere =
                target_shape({round.vertices, twice, std::vector<std::uint32_t>(twice.size(), 0)});
            CHECK(sphere.triangles.size() <= round.triangles.size());
            CHECK(sphere.closed);
            CHECK(sphere.curvature_m == test::approx(2.0).epsilon(0.01));
            for (const TargetTriangle& triangle : sphere.triangles) {
                for (int k = 0; k < 3; ++k) {
                    const Eigen::Vector3f out =
                        (sphere.vertices[triangle.corners[k]] - Eigen::Vector3f(3, 4, 5)) / 2.0F;
                    CHECK((triangle.normals[k] - out).norm() < 1e-3F);
                }
            }
        }
    }
}
