#include "benchmark/scaling.h"

#include <doctest/doctest.h>

#include "scene/copies.h"
#include "support/approx.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

double area(const Scene& scene) {
    double sum = 0.0;
    for (const auto& [a, b, c] : scene.triangles) {
        const Eigen::Vector3f u = scene.vertices[b] - scene.vertices[a];
        const Eigen::Vector3f v = scene.vertices[c] - scene.vertices[a];
        sum += 0.5 * u.cross(v).norm();
    }
    return sum;
}

}  // namespace

TEST_SUITE_BEGIN("benchmark");

TEST_CASE("a subdivided scene has four times the triangles and the same area") {
    Scene scene = empty_scene();
    scene.vertices = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.triangle_material.assign(2, add_material(scene, 0.5F));
    scene.triangle_instance.assign(2, 0);
    const Scene fine = subdivide(scene);
    CHECK(fine.triangles.size() == 8);
    CHECK(fine.triangle_material.size() == 8);
    CHECK(fine.triangle_instance.size() == 8);
    // Four corners, and the middles of four sides and of the diagonal, which both triangles share.
    CHECK(fine.vertices.size() == 9);
    CHECK(area(fine) == test::approx(16.0));
}

TEST_CASE("tiles lie side by side around the original") {
    Scene scene = empty_scene();
    add_floor(scene, 2.0F, 0.0F, add_material(scene, 0.5F));
    scene.bounds_min = {-2.0, -2.0, 0.0};
    scene.bounds_max = {2.0, 2.0, 0.0};
    const Scene wide = tile(scene, 3);
    CHECK(wide.triangles.size() == 18);
    CHECK(area(wide) == test::approx(144.0));
    CHECK(wide.bounds_min == Eigen::Vector3d(-6.0, -6.0, 0.0));
    CHECK(wide.bounds_max == Eigen::Vector3d(6.0, 6.0, 0.0));
    CHECK(wide.triangles[0] == scene.triangles[0]);  // the original comes first, unmoved
    for (const Eigen::Vector3f& v : wide.vertices) {
        CHECK(std::fabs(v.x()) <= 6.0F);
        CHECK(std::fabs(v.y()) <= 6.0F);
    }
}

TEST_CASE("copies of a shared mesh grow along") {
    Scene scene = empty_scene();
    add_floor(scene, 2.0F, 0.0F, add_material(scene, 0.5F));
    scene.bounds_min = {-2.0, -2.0, 0.0};
    scene.bounds_max = {2.0, 2.0, 0.0};
    scene.shared_meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0}});
    Eigen::Affine3d T_world_mesh = Eigen::Affine3d::Identity();
    T_world_mesh.linear() = 0.5 * Eigen::Matrix3d::Identity();
    T_world_mesh.translation() = Eigen::Vector3d(1.0, 0.5, 0.25);
    scene.copies.push_back({0, 0, T_world_mesh});
    CHECK(all_triangles(scene) == 3);
    const Scene fine = subdivide(scene);
    CHECK(all_triangles(fine) == 12);
    CHECK(fine.shared_meshes[0].triangle_material.size() == 4);
    const Scene wide = tile(scene, 3);
    CHECK(all_triangles(wide) == 27);
    REQUIRE(wide.copies.size() == 9);
    Eigen::AlignedBox3d origins;
    for (const MeshCopy& copy : wide.copies)
        origins.extend(copy.T_world_mesh * Eigen::Vector3d::Zero());
    // One tile of 4 m to each side.
    CHECK(origins.min() == Eigen::Vector3d(-3.0, -3.5, 0.25));
    CHECK(origins.max() == Eigen::Vector3d(5.0, 4.5, 0.25));
}

TEST_SUITE_END();
