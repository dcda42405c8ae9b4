#include "preview/object_boxes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "support/scenes.h"

using namespace sonarsim;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// A floor and two crates, nodes of their own.
Assembly floor_with_crates() {
    Assembly assembly;
    Scene& scene = assembly.scene;
    scene = test::empty_scene();
    const std::uint32_t material = test::add_material(scene, 0.5F);
    std::vector<std::uint32_t> instances;
    test::add_floor(scene, 20.0F, 0.0F, material);
    instances.resize(scene.triangles.size(), 0);
    test::add_box(scene, {5.0F, 2.0F, 0.0F}, {6.0F, 4.0F, 3.0F}, material);
    instances.resize(scene.triangles.size(), 1);
    test::add_box(scene, {-6.0F, -4.0F, 0.0F}, {-5.0F, -2.0F, 1.0F}, material);
    instances.resize(scene.triangles.size(), 2);
    scene.triangle_instance = instances;
    scene.instances = {"floor", "crate 1", "crate 2"};
    assembly.trajectory = {{0.0, {}}};
    return assembly;
}

}  // namespace

TEST_SUITE("preview") {
    TEST_CASE("object boxes: nodes are the objects of a mission without labels") {
        const Assembly assembly = floor_with_crates();
        REQUIRE(assembly.objects.object_of_instance.empty());
        const std::vector<ObjectBox> boxes = object_boxes(assembly, 0);
        REQUIRE(boxes.size() == 3);
        CHECK(boxes[1].name == "crate 1");
        CHECK(boxes[1].box.min().isApprox(Vector3d(5.0, 2.0, 0.0)));
        CHECK(boxes[1].box.max().isApprox(Vector3d(6.0, 4.0, 3.0)));
    }

    TEST_CASE("object boxes: nodes are grouped as labels are, and background is left out") {
        Assembly assembly = floor_with_crates();
        assembly.objects.objects = {{"ground", 0}, {"crates", 1}};
        assembly.objects.classes = {"ground", "cargo"};
        assembly.objects.background = {1, 0};
        assembly.objects.object_of_instance = {0, 1, 1};
        const std::vector<ObjectBox> boxes = object_boxes(assembly, 0);
        REQUIRE(boxes.size() == 1);
        CHECK(boxes[0].name == "crates");
        CHECK(boxes[0].box.min().isApprox(Vector3d(-6.0, -4.0, 0.0)));
    }

    TEST_CASE(
        "objects in the plan: names lie within it and over no other name, the floor has none") {
        const PlaneFrame frame = plane_frame(600, 420, {-20.0, -20.0}, {20.0, 20.0});
        std::mt19937 random(7);
        std::uniform_real_distribution<double> place(-22.0, 22.0);
        std::vector<ObjectBox> objects{
            {"floor", {Vector3d(-20.0, -20.0, 0.0), Vector3d(20.0, 20.0, 0.0)}}};
        for (int k = 0; k < 60; ++k) {
            const double x = place(random);
            const double y = place(random);
            objects.push_back({"object number " + std::to_string(k),
                               {Vector3d(x, y, 0.0), Vector3d(x + 1.0, y + 1.0, 1.0)}});
        }
        Picture tile(600, 420, backdrop);
        const std::vector<Eigen::AlignedBox2d> names = draw_objects(tile, frame, objects);
        CHECK(names.size() == 20);
        for (std::size_t k = 0; k < names.size(); ++k) {
            CHECK(names[k].min().x() >= frame.left);
            CHECK(names[k].max().x() <= frame.left + frame.plot_width);
            CHECK(names[k].sizes().x() >= text_width("object number 1"));
            for (std::size_t other = 0; other < k; ++other)
                CHECK_FALSE(names[k].intersects(names[other]));
        }
    }
}
