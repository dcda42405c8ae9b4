#include "simulate/visibility/caster.h"

#include "support/test.h"

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

    TEST_CASE("caster: scenes with the same first file share its tree and have their own hits") {
        const auto scene_with = [](float x) {
            Scene scene = empty_scene();
            const std::uint32_t material = add_material(scene, 1.0F);
            add_sphere(scene, {0, 0, -8}, 1.0F, material, 256);
            scene.first_file_triangles = scene.triangles.size();
            scene.first_file_vertices = scene.vertices.size();
            add_sphere(scene, {x, 0, -7}, 0.5F, material, 64);
            return scene;
        };
        std::vector<Eigen::Vector3f> directions;
        for (int k = -100; k <= 100; ++k)
            directions.push_back(Eigen::Vector3f(0.003F * static_cast<float>(k), 0.01F, -1));
        const auto hits = [&](const Caster& caster) {
            std::vector<std::uint32_t> facets(directions.size());
            caster.cast(Eigen::Vector3f::Zero(), directions, 100.0F, facets);
            std::vector<float> heights;
            for (const std::uint32_t facet : facets)
                heights.push_back(facet == Caster::nothing ? 0.0F : caster.facet(facet).vertex.z());
            return heights;
        };
        SharedTrees shared;
        for (const float x : {0.5F, 1.0F, -1.0F, 0.5F}) {
            Scene scene = scene_with(x);
            const std::vector<float> by_shared = hits(shared.caster(scene));
            scene.first_file_triangles = 0;  // one tree of all
            CHECK(by_shared == hits(Caster(scene)));
        }
    }
}
