#include "visibility/caster.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("visibility") {
    // Embree took the sign of such a component for its octant, but divided by +1e-18: rays of its
    // packet passed through the scene.
    TEST_CASE("caster: a ray with a component near zero does not disturb its neighbours") {
        Scene scene = empty_scene();
        add_sphere(scene, {0, 0, -8}, 1.0F, add_material(scene, 1.0F), 256);
        const Caster caster(scene);
        for (const float tiny : {-4.84e-19F, -1e-30F, -0.0F, 4.84e-19F, -1e-17F}) {
            std::vector<Eigen::Vector3f> directions{{tiny, -0.002F, -1}};
            for (int k = 1; k < 8; ++k)
                directions.emplace_back(-0.01F * static_cast<float>(k), -0.002F, -1);
            for (Eigen::Vector3f& direction : directions)
                direction.normalize();
            std::vector<std::uint32_t> facets(directions.size());
            caster.cast(Eigen::Vector3f::Zero(), directions, 100.0F, facets);
            CAPTURE(tiny);
            for (const std::uint32_t facet : facets)
                CHECK(facet != Caster::nothing);
        }
    }

    TEST_CASE("caster: may_meet() excludes rays that lead away from the box around the scene") {
        // A sphere in [-1, 1]^3, and a body that is moved to [9, 11] x [-1, 1]^2.
        Scene scene = empty_scene();
        const std::uint32_t m = add_material(scene, 1.0F);
        add_sphere(scene, {0, 0, 0}, 1.0F, m, 32);
        Body body{.instance = 0,
                  .vertices = scene.vertices,
                  .triangles = scene.triangles,
                  .triangle_material = scene.triangle_material};
        const Caster still(scene);
        CHECK(still.may_meet({0, 0, 0}, {0, 0, 1}));
        CHECK(still.may_meet({5, 0, 0}, {-1, 0, 0}));
        CHECK(!still.may_meet({5, 0, 0}, {1, 0, 0}));
        CHECK(!still.may_meet({5, 0, 0}, {0, 1, 0}));
        CHECK(!still.may_meet({0, -5, 0}, Eigen::Vector3f(0.9F, -0.1F, 0).normalized()));
        // It leads towards the box and passes next to it, which this test does not exclude.
        CHECK(still.may_meet({5, 0, 0}, Eigen::Vector3f(-0.1F, 1, 0).normalized()));
        scene.bodies.push_back(std::move(body));
        const Caster moved =
            Caster(scene).moved(std::vector<Pose>{{Eigen::Quaterniond::Identity(), {10, 0, 0}}});
        CHECK(moved.may_meet({5, 0, 0}, {1, 0, 0}));
        CHECK(!moved.may_meet({12, 0, 0}, {1, 0, 0}));
        CHECK(moved.may_meet({12, 0, 0}, {-1, 0, 0}));
        const Caster empty(empty_scene());
        CHECK(!empty.may_meet({0, 0, 0}, {1, 0, 0}));
    }
}
