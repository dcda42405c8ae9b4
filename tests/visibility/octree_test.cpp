#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include "core/error.h"
#include "core/units.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "visibility/caster.h"
#include "visibility/octree/leaf.h"
#include "visibility/octree/octree_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

namespace {

View tank_view() {
    return {radians(60.0), radians(12.0), 0.5, 10.0, 512, 256, 0.03};
}

Pose tank_pose(int k) {
    return {rotation_from_rpy(0.0, radians(5.0 + 5.0 * k), radians(20.0 - 12.0 * k)),
            Eigen::Vector3d(-3.0 + 0.3 * k, -1.0 + 0.7 * k, 1.5)};
}

/// A view of all directions that azimuth and elevation can express.
View wide_view(double reach) {
    return {radians(360.0), radians(170.0), 0.0, reach, 64, 64, 0.03};
}

double scene_area(const Scene& scene) {
    double sum = 0.0;
    for (const auto& t : scene.triangles) {
        const Eigen::Vector3d a = scene.vertices[t[0]].cast<double>();
        const Eigen::Vector3d b = scene.vertices[t[1]].cast<double>();
        const Eigen::Vector3d c = scene.vertices[t[2]].cast<double>();
        sum += 0.5 * (b - a).cross(c - a).norm();
    }
    return sum;
}

bool same_samples(const Samples& a, const Samples& b) {
    return a.beam_begin == b.beam_begin && a.items.size() == b.items.size() &&
           std::equal(a.items.begin(), a.items.end(), b.items.begin(),
                      [](const Sample& x, const Sample& y) {
                          return x.position == y.position && x.edge_u == y.edge_u &&
                                 x.edge_v == y.edge_v && x.normal == y.normal &&
                                 x.area_m2 == y.area_m2 && x.material == y.material &&
                                 x.instance == y.instance;
                      });
}

std::vector<std::uint32_t> all_triangles(const Scene& scene) {
    std::vector<std::uint32_t> all(scene.triangles.size());
    for (std::uint32_t i = 0; i < all.size(); ++i)
        all[i] = i;
    return all;
}

}  // namespace

TEST_CASE("octree: its leaves hold the surface of the scene, no more and no less" *
          doctest::skip(test::sanitized)) {
    const Scene scene = test::tank();
    for (const bool literal : {false, true}) {
        for (const double leaf : {0.0, 0.31, 0.1}) {
            const auto octree = make_octree_engine(scene, {leaf, 512, literal});
            const double truth = scene_area(scene);
            CHECK(octree->statistics().leaf_area_m2 == test::approx(truth).epsilon(1e-5));
            octree->visible_surface(wide_view(20.0),
                                    {Eigen::Quaterniond::Identity(), {0.3, 0.2, 1.1}});
            octree->visible_surface(tank_view(), tank_pose(0));
            CHECK(octree->statistics().leaves > 100);
            CHECK(octree->statistics().leaf_area_m2 == test::approx(truth).epsilon(1e-5));
        }
    }
}

TEST_CASE("octree: a tilted plane keeps its area, too, and so does one on round coordinates") {
    Scene scene = test::empty_scene();
    const auto material = test::add_material(scene, 0.5F);
    test::add_quad(scene, {-1, -2, 0.1F}, {1.2F, -1.7F, 1}, {0.5F, 2, 1.5F}, {-2, 1.5F, 0.2F},
                   material, 3);
    test::add_floor(scene, 2.0F, 0.0F, material);
    const auto octree = make_octree_engine(scene, {0.125, 512, false});
    octree->visible_surface(wide_view(10.0), {Eigen::Quaterniond::Identity(), {0, 0, 3}});
    CHECK(octree->statistics().leaf_area_m2 == test::approx(scene_area(scene)).epsilon(1e-5));
}

TEST_CASE("octree leaf: the section of a cube by a plane along it is that square") {
    Scene scene = test::empty_scene();
    test::add_floor(scene, 10.0F, 0.25F, test::add_material(scene, 0.5F));
    const Caster caster(scene);
    std::vector<LeafFacet> facets;
    const int count =
        LeafMaker(scene, caster).append({{1, 2, 0}, 0.5}, all_triangles(scene), facets);
    REQUIRE(count == 1);
    const LeafFacet facet = facets[0];
    CHECK((facet.centre - Eigen::Vector3f(1.25F, 2.25F, 0.25F)).norm() < 1e-6F);
    CHECK(std::fabs(facet.normal.z()) == test::approx(1.0));
    CHECK(facet.area_m2 == test::approx(0.25));
    CHECK(facet.edge_u.norm() == test::approx(0.25));
    CHECK(facet.edge_v.norm() == test::approx(0.25));
    CHECK(facet.thickness_m < 1e-6F);
    CHECK(is_flat_rectangle(facet));
}

TEST_CASE("octree leaf: on a sphere, normals are radial and centroids lie just inside") {
    Scene scene = test::empty_scene();
    test::add_sphere(scene, {0, 0, 0}, 1.0F, test::add_material(scene, 0.5F));
    const Caster caster(scene);
    const LeafMaker maker(scene, caster);
    std::vector<LeafFacet> facets;
    // A cube of 0.1 m about the point (0.6, 0, 0.8) of the sphere.
    const int count = maker.append({{0.55, -0.05, 0.75}, 0.1}, all_triangles(scene), facets);
    REQUIRE(count == 1);
    const LeafFacet facet = facets[0];
    CHECK(facet.normal.cross(facet.centre.normalized()).norm() < 5e-3F);
    // The mean distance of a cap of angular radius a lies a^2 / 4 below the radius; a ~ 0.07.
    CHECK(facet.centre.norm() < 1.0F);
    CHECK(facet.centre.norm() > 0.997F);
    CHECK(facet.thickness_m < 3e-3F);
}

TEST_CASE("octree leaf: a thin plate keeps both faces, and the larger material comes first") {
    Scene scene = test::empty_scene();
    const auto steel = test::add_material(scene, 0.9F);
    const auto wood = test::add_material(scene, 0.1F);
    test::add_quad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, steel);
    test::add_quad(scene, {-1, -1, -0.01F}, {-1, 1, -0.01F}, {1, 1, -0.01F}, {1, -1, -0.01F},
                   steel);
    test::add_quad(scene, {-1, 0.3F, 0}, {0.2F, 0.3F, 0}, {0.2F, 0.3F, 1}, {-1, 0.3F, 1}, wood);
    const Caster caster(scene);
    std::vector<LeafFacet> facets;
    REQUIRE(LeafMaker(scene, caster).append({{0, 0, -0.25}, 0.5}, all_triangles(scene), facets) ==
            3);
    CHECK(facets[0].normal.dot(facets[1].normal) == test::approx(-1.0));
    CHECK(facets[0].area_m2 == test::approx(0.25));
    CHECK(facets[1].area_m2 == test::approx(0.25));
    // 0.2 m by 0.25 m.
    CHECK(facets[2].area_m2 == test::approx(0.05));
    CHECK(scene.triangle_material[facets[0].triangle] == steel);
    CHECK(scene.triangle_material[facets[2].triangle] == wood);
}

TEST_CASE("octree: samples face the sonar and stay in their beam") {
    const Scene scene = test::tank();
    const View view = tank_view();
    const auto octree = make_octree_engine(scene, {0.04, 512, false});
    const Samples samples = octree->visible_surface(view, tank_pose(1));
    REQUIRE(samples.beam_begin.size() == 257);
    REQUIRE(samples.items.size() > 1000);
    for (int j = 0; j < view.beams; ++j) {
        const double low = (static_cast<double>(j) / view.beams - 0.5) * view.azimuth_rad;
        const double high = low + view.azimuth_rad / view.beams;
        for (const Sample& s : samples.beam(j)) {
            CHECK(s.normal.dot(s.position) <= 0.0F);
            CHECK(s.area_m2 > 0.0F);
            for (const float side : {-1.0F, 1.0F}) {
                const Eigen::Vector3f end = s.position + side * s.edge_u;
                const double azimuth = std::atan2(end.y(), end.x());
                // Accurate to second order in the size of a leaf; a beam has 4 mrad.
                CHECK(azimuth > low - 2e-4);
                CHECK(azimuth < high + 2e-4);
            }
        }
    }
}

TEST_CASE("octree: only tiles in view are refined") {
    const Scene scene = test::tank();
    const auto octree = make_octree_engine(scene, {0.02, 512, false});
    CHECK(octree->statistics().nodes == 1);
    octree->visible_surface(tank_view(), tank_pose(0));
    const OctreeStatistics once = octree->statistics();
    octree->visible_surface(tank_view(), tank_pose(0));
    CHECK(octree->statistics().nodes == once.nodes);
    octree->visible_surface(wide_view(20.0), tank_pose(0));
    CHECK(octree->statistics().nodes > 2 * once.nodes);
}

TEST_CASE("octree: a ping that is ready changes nothing, and shows the same as any other") {
    const Scene scene = test::tank();
    for (const bool literal : {false, true}) {
        for (const std::size_t memory_mb : {512U, 1U}) {
            if (test::sanitized && (literal || memory_mb != 1U)) continue;
            const auto octree = make_octree_engine(scene, {0.02, memory_mb, literal});
            const Sight sight{tank_view(), tank_pose(2)};
            const auto ready = octree->prepared(std::span(&sight, 1));
            REQUIRE(ready);
            const OctreeStatistics before = octree->statistics();
            CHECK(before.nodes > 1);
            const Samples found = ready->visible_surface(sight.view, sight.T_world_sensor);
            const OctreeStatistics after = octree->statistics();
            CHECK(after.nodes == before.nodes);
            CHECK(after.evictions == before.evictions);
            // Other pings may drop its tiles from the tree meanwhile.
            for (int k = 0; k < 4; ++k)
                octree->visible_surface(tank_view(), tank_pose(k));
            CHECK(same_samples(ready->visible_surface(sight.view, sight.T_world_sensor), found));
            const auto other = make_octree_engine(scene, {0.02, 512, literal});
            CHECK(same_samples(other->visible_surface(sight.view, sight.T_world_sensor), found));
            // Another ping is prepared when it is asked for.
            CHECK(same_samples(ready->visible_surface(tank_view(), tank_pose(3)),
                               other->visible_surface(tank_view(), tank_pose(3))));
        }
    }
}

TEST_CASE("octree: the same bytes for any number of threads and any order") {
    const Scene scene = test::tank();
    constexpr int pings = test::sanitized ? 4 : 8;
    for (const double leaf : {0.0, 0.04}) {
        const auto alone = make_octree_engine(scene, {leaf, 512, false});
        std::array<Samples, pings> expected;
        for (int k = 0; k < pings; ++k)
            expected[k] = alone->visible_surface(tank_view(), tank_pose(k % 4));
        const auto shared = make_octree_engine(scene, {leaf, 512, false});
        std::array<Samples, pings> found;
        std::vector<std::thread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&, t] {
                for (int k = pings - 1 - t; k >= 0; k -= 4)
                    found[k] = shared->visible_surface(tank_view(), tank_pose(k % 4));
            });
        }
        for (std::thread& thread : threads)
            thread.join();
        for (int k = 0; k < pings; ++k)
            CHECK(same_samples(expected[k], found[k]));
    }
}

TEST_CASE("octree: eviction bounds the memory and changes no sample") {
    const Scene scene = test::tank();
    const auto roomy = make_octree_engine(scene, {0.02, 512, false});
    const auto tight = make_octree_engine(scene, {0.02, 2, false});
    for (int k = 0; k < (test::sanitized ? 4 : 8); ++k) {
        const Samples expected = roomy->visible_surface(tank_view(), tank_pose(k % 4));
        const Samples found = tight->visible_surface(tank_view(), tank_pose(k % 4));
        CHECK(same_samples(expected, found));
        CHECK(tight->statistics().bytes <= 2U << 20U);
    }
    CHECK(roomy->statistics().evictions == 0);
    CHECK(tight->statistics().evictions > 0);
    CHECK(roomy->statistics().bytes > 3U << 20U);
}

TEST_CASE("octree: rays are traced as the ray engine does") {
    const Scene scene = test::tank();
    const auto octree = make_octree_engine(scene, {});
    const Pose pose{Eigen::Quaterniond::Identity(), {0, 0, 1}};
    const std::array rays{Ray{{0, 0, 0}, {0, 0, -1}}, Ray{{0, 0, 0}, {0, 0, 1}}};
    std::array<Intersection, 2> hits;
    octree->intersect(pose, rays, hits);
    CHECK(hits[0].distance_m == test::approx(1.0));
    CHECK(hits[0].normal.z() == test::approx(1.0));
    CHECK(std::isinf(hits[1].distance_m));
}

TEST_CASE("octree: an empty scene shows nothing") {
    const Scene scene = test::empty_scene();
    const auto octree = make_octree_engine(scene, {});
    const Samples samples = octree->visible_surface(tank_view(), tank_pose(0));
    CHECK(samples.items.empty());
    CHECK(samples.beam_begin.size() == 257);
}

TEST_CASE("octree: bad leaf sizes are refused") {
    const Scene scene = test::tank();
    CHECK_THROWS_WITH_AS(make_octree_engine(scene, {-0.1}),
                         doctest::Contains("leaf_m must be positive"), InputError);
    CHECK_THROWS_WITH_AS(make_octree_engine(scene, {1e-10}),
                         doctest::Contains("leaf_m is too small"), InputError);
}

TEST_CASE("octree literal: one leaf one vote, and a gap of four leaves ends a cluster") {
    // Two walls at normal incidence in one beam and one elevation cell, 0.3 m or 0.5 m apart;
    // leaves of 0.1 m. The farther wall is kept at three leaves and lost at five.
    for (const float apart : {0.3F, 0.55F}) {
        Scene scene = test::empty_scene();
        const auto material = test::add_material(scene, 0.5F);
        for (const float x : {5.0F, 5.0F + apart})
            test::add_quad(scene, {x, -1, -1}, {x, 1, -1}, {x, 1, 1}, {x, -1, 1}, material);
        const auto literal = make_octree_engine(scene, {0.1, 512, true});
        const View view{radians(2.0), radians(1.0), 0.5, 10.0, 100, 1, 0.03};
        const Samples samples = literal->visible_surface(view, {});
        REQUIRE(!samples.items.empty());
        float farthest = 0.0F;
        for (const Sample& s : samples.items) {
            CHECK(s.area_m2 == 1.0F);
            CHECK(s.edge_u.norm() == 0.0F);
            CHECK(s.edge_v.norm() == 0.0F);
            farthest = std::max(farthest, s.position.norm());
        }
        CHECK((farthest > 5.2F) == (apart < 0.4F));
    }
}

TEST_SUITE_END();
