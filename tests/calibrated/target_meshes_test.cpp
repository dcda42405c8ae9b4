#include "calibrated/target_fixtures.h"
#include "simulate/trace/target_shapes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    TEST_CASE("targets: bodies that move and copies of a mesh are sampled where they are") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const BallScene still({8.0, 0.3, 0.2}, 0.15, 32);
        const double expected = energy_by_rays(sonar, still.scene);
        // Spheres about the origin of their own frames, of half of the radius for the copy.
        const auto mesh_of = [](float radius) {
            Scene mesh = empty_scene();
            add_sphere(mesh, {0, 0, 0}, radius, add_material(mesh, 0.8F), 32);
            return mesh;
        };
        const Scene ball = mesh_of(0.15F);
        const Scene half = mesh_of(0.075F);

        Scene moving = metal_scene();
        moving.bodies.push_back({0, ball.vertices, ball.triangles, ball.triangle_material});
        const auto engine = make_engine(moving, {.type = EngineKind::rays, .octree = {}});
        const Pose there{rotation_from_rpy(0.0, 0.0, 0.7), {8.0, 0.3, 0.2}};
        CHECK(energy_by(sonar, moving, *engine->at({&there, 1})) ==
              test::approx(expected).epsilon(0.01));

        Scene copied = metal_scene();
        copied.shared_meshes.push_back({half.vertices, half.triangles, half.triangle_material});
        MeshCopy copy{.mesh = 0, .instance = 0};
        copy.T_world_mesh = Eigen::Translation3d(8.0, 0.3, 0.2) * Eigen::Scaling(2.0);
        copied.copies.push_back(copy);
        CHECK(energy_by_rays(sonar, copied) == test::approx(expected).epsilon(0.01));
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
