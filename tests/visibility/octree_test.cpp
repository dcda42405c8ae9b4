#include "simulate/visibility/octree/tree.h"
#include "support/test.h"

TEST_CASE("octree: a wall has one leaf for every cube that it is in") {
    const Scene scene = rectangle_scene({4, -1, -1}, {4, 1, 1}, 0.5F);
    const View view{radians(60.0), radians(60.0), 0.5, 8.0, 100, 60, 0.03};
    for (const double leaf_m : {0.1, 0.05}) {
        const Samples samples = make_octree_engine(scene, leaf_m)->visible_surface(view, Pose{});
        const double cubes = 2.0 / leaf_m;
        CHECK(static_cast<double>(samples.items.size()) > cubes * cubes);
        CHECK(static_cast<double>(samples.items.size()) < (cubes + 1.0) * (cubes + 1.0) + 1.0);
        for (const Sample& sample : samples.items) {
            CHECK(std::fabs(sample.position.x() - 4.0F) <= 0.51F * static_cast<float>(leaf_m));
            CHECK(sample.normal.x() == approx(-1.0));
        }
    }
}

TEST_CASE("octree: the first cluster of leaves hides what is more than four leaves behind it") {
    Scene scene = rectangle_scene({3, -0.6F, -0.6F}, {3, 0.6F, 0.6F}, 0.9F);
    const auto wall = add_material(scene, 0.5F);
    // At the plate a pixel is at least as large as a leaf, so that none is empty.
    const View view{radians(60.0), radians(60.0), 0.5, 5.0, 100, 60, 0.03};
    for (const float behind : {0.12F, 1.0F}) {
        Scene both = scene;
        const float x = 3.0F + behind;
        add_rectangle(both, {x, -2, -2}, {x, 2, 2}, wall);
        int in_shadow = 0;
        for (const Sample& sample :
             make_octree_engine(both, 0.05)->visible_surface(view, Pose{}).items) {
            if (sample.material != wall) continue;
            const Eigen::Vector3f at_plate = sample.position * (3.0F / sample.position.x());
            in_shadow += std::max(std::fabs(at_plate.y()), std::fabs(at_plate.z())) < 0.5F;
        }
        CHECK((in_shadow > 0) == (behind < 0.2F));
    }
}

TEST_CASE("octree: an empty scene has no leaves, and leaves may be too small for a scene") {
    const Scene empty = empty_scene();
    const View view{radians(60.0), radians(12.0), 0.5, 10.0, 512, 256, 0.03};
    CHECK(make_octree_engine(empty, 0.02)->visible_surface(view, Pose{}).items.empty());
    Scene scene = floor_scene(1e6F, 0.0F, 0.5F);
    CHECK_THROWS_AS(make_octree_engine(scene, 1e-3), InputError);
}
