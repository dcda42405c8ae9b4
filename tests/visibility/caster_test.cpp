#include "simulate/visibility/caster.h"

#include "support/draws.h"

namespace {

/// A slanted square, cut into n x n x 2 triangles.
void add_slanted(Scene& scene, int n) {
    const Eigen::Vector3f middle(7.3F, -4.1F, 2.7F);
    const Eigen::Vector3f u(5.0F, 1.7F, -0.9F);
    const Eigen::Vector3f v(-1.1F, 4.3F, 2.2F);
    add_quad(scene, middle - u - v, middle + u - v, middle + u + v, middle - u + v, 0, n);
}

/// The number of rays, of `rays` from drawn places to a triangle's plane at incidences down to 2
/// degrees of grazing, that meet a facet below `count`.
int met_below(const Caster& caster, std::uint32_t count, int rays) {
    Draws draws(count);
    const Facet plane = caster.facet(0);
    const Facet last = caster.facet(count - 1);
    int below = 0;
    for (int k = 0; k < rays; ++k) {
        const Eigen::Vector3f along = plane.normal.cross(draws.in_ball()).normalized();
        const Eigen::Vector3f to = plane.vertex +
                                   draws.between(0.3F, 0.7F) * (last.vertex - plane.vertex) +
                                   draws.between(-0.5F, 0.5F) * along;
        const float height = draws.scale(0.03F, 1.0F);
        const Eigen::Vector3f direction = (along - height * plane.normal).normalized();
        const Eigen::Vector3f origin = to - 6.0F * direction;
        std::uint32_t facet = Caster::nothing;
        caster.cast(origin, {&direction, 1}, 20.0F, {&facet, 1});
        below += facet < count ? 1 : 0;
    }
    return below;
}

}  // namespace

// Embree took such a component's sign for its octant, but divided by +1e-18: rays were lost.
TEST_CASE("caster: a ray with a component near zero does not disturb its neighbours") {
    const Scene scene = sphere_scene({0, 0, -8}, 1.0F, 1.0F);
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
        Scene scene = sphere_scene({0, 0, -8}, 1.0F, 1.0F);
        scene.first_file_triangles = scene.triangles.size();
        scene.first_file_vertices = scene.vertices.size();
        add_sphere(scene, {x, 0, -7}, 0.5F, 0, 64);
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
        if (x == 1.0F) add_sphere(scene, {9, 9, 9}, 0.1F, 0, 16);  // an own number of triangles
        const std::vector<float> by_shared = hits(shared.caster(scene));
        CHECK(shared.caster(scene).placed_triangles() == scene.triangles.size());
        scene.first_file_triangles = 0;  // one tree of all
        CHECK(by_shared == hits(Caster(scene)));
    }
}

// Embree's distances contain estimates of reciprocals, and so did these decisions.
TEST_CASE("caster: of facets that coincide the first counts, on every processor") {
    constexpr int rays = 4000;
    for (const int n : {3, 5}) {
        Scene scene = empty_scene();
        add_material(scene, 1.0F);
        add_slanted(scene, n);
        const auto first = static_cast<std::uint32_t>(scene.triangles.size());
        add_slanted(scene, 8 - n);
        CHECK(met_below(Caster(scene), first, rays) == rays);
        Scene placed = empty_scene();
        placed.materials = scene.materials;
        placed.instances = scene.instances;
        placed.shared_meshes.push_back({scene.vertices, scene.triangles, scene.triangle_material});
        const Eigen::Affine3d T = Eigen::Translation3d(1.0, 2.0, 3.0) *
                                  rotation_from_rpy(0.3, 0.2, -0.4) * Eigen::Scaling(0.7);
        placed.copies.push_back({0, 0, T});
        CHECK(met_below(Caster(placed), first, rays) == rays);
    }
}

TEST_CASE("caster: a ray meets a facet up to the distance of its plane and no further") {
    const Scene scene = sphere_scene({3, -2, 1}, 1.0F, 1.0F, 64);
    const Caster caster(scene);
    const Eigen::Vector3f origin(-4.0F, 1.5F, 2.5F);
    Draws draws(1);
    for (int k = 0; k < 4000; ++k) {
        const Eigen::Vector3f to = Eigen::Vector3f(3, -2, 1) + 0.95F * draws.in_ball();
        const Eigen::Vector3f direction = (to - origin).normalized();
        const auto met = [&](float reach_m) -> std::uint32_t {
            std::uint32_t facet = Caster::nothing;
            caster.cast(origin, {&direction, 1}, reach_m, {&facet, 1});
            return facet;
        };
        const std::uint32_t facet = met(100.0F);
        REQUIRE(facet != Caster::nothing);
        const Facet plane = caster.facet(facet);
        const float distance =
            plane.normal.dot(plane.vertex - origin) / plane.normal.dot(direction);
        CHECK(met(distance) == facet);
        CHECK(met(std::nextafter(distance, 0.0F)) == Caster::nothing);
    }
}
