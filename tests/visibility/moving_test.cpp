#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/scenes.h"
#include "visibility/make_engine.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The triangles of a scene as a moving body, in a scene with nothing else.
Scene as_body(const Scene& shape) {
    Scene scene = empty_scene();
    scene.materials = shape.materials;
    scene.instances = {"body"};
    scene.instance_classes = {""};
    scene.bodies.push_back({0, shape.vertices, shape.triangles, shape.triangle_material});
    return scene;
}

}  // namespace

TEST_SUITE("visibility") {
    TEST_CASE("moving: a sphere that flies past is met where it is, at every moment") {
        constexpr double radius = 0.5;
        Scene shape = empty_scene();
        add_sphere(shape, {0, 0, 0}, static_cast<float>(radius), add_material(shape, 1.0F), 512);
        const Scene scene = as_body(shape);
        const auto engine = make_rays_engine(scene);
        // A ray from the origin along x meets a sphere at (a, b, 0) at a - sqrt(r^2 - b^2). The
        // facets are at most r (1 - cos(pi / 512)) = 9.4 um inside the sphere; along the ray that
        // is longer by 1 / cos(incidence), below 2.6 here.
        const Ray ray{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()};
        for (int k = -9; k <= 9; ++k) {
            const double b = 0.05 * k;
            const double a = 5.0 + 0.1 * k;
            const Pose pose{rotation_from_rpy(0.3 * k, 0.2, 0.1 * k), {a, b, 0.0}};
            const auto now = engine->at({&pose, 1});
            Intersection hit{};
            now->intersect({}, {&ray, 1}, {&hit, 1});
            const double expected = a - std::sqrt(radius * radius - b * b);
            CHECK(std::fabs(hit.distance_m - expected) < 1e-4);
            const Eigen::Vector3d normal =
                (Eigen::Vector3d(expected, 0.0, 0.0) - pose.translation) / radius;
            CHECK((hit.normal.cast<double>() - normal).norm() < 0.02);
            CHECK(hit.instance == 0);
        }
        // A ray meets nothing before the body is placed, nor next to it.
        Intersection hit{};
        engine->intersect({}, {&ray, 1}, {&hit, 1});
        CHECK(std::isinf(hit.distance_m));
        const Pose beside{Eigen::Quaterniond::Identity(), {5.0, 0.6, 0.0}};
        engine->at({&beside, 1})->intersect({}, {&ray, 1}, {&hit, 1});
        CHECK(std::isinf(hit.distance_m));
    }

    TEST_CASE("moving: what is seen is that of a scene with everything in its place") {
        Scene box_shape = empty_scene();
        add_box(box_shape, {-0.4F, -0.3F, -0.2F}, {0.4F, 0.3F, 0.2F},
                add_material(box_shape, 0.5F));
        Scene scene = as_body(box_shape);
        add_floor(scene, 20.0F, 0.0F, 0, 16);
        scene.instances.emplace_back("floor");
        scene.instance_classes.emplace_back("");
        for (std::uint32_t& instance : scene.triangle_instance)
            instance = 1;
        const View view{.azimuth_rad = radians(60.0),
                        .elevation_rad = radians(20.0),
                        .range_min_m = 0.5,
                        .range_max_m = 10.0,
                        .range_bins = 256,
                        .beams = 64,
                        .relative_l1 = 0.03};
        const Pose sonar{rotation_from_rpy(0, 0.3, 0), {0, 0, 2}};
        const auto engine = make_rays_engine(scene);
        for (const double y : {-1.0, 0.0, 0.7}) {
            const Pose pose{rotation_from_rpy(0, 0, y), {5.0, y, 0.5}};
            Scene still = empty_scene();
            still.materials = scene.materials;
            add_floor(still, 20.0F, 0.0F, 0, 16);
            const std::size_t floor = still.triangles.size();
            const std::size_t first = still.vertices.size();
            add_box(still, {-0.4F, -0.3F, -0.2F}, {0.4F, 0.3F, 0.2F}, 0);
            for (std::size_t v = first; v < still.vertices.size(); ++v) {
                still.vertices[v] =
                    (pose.rotation * still.vertices[v].cast<double>() + pose.translation)
                        .cast<float>();
            }
            for (std::size_t t = 0; t < still.triangles.size(); ++t)
                still.triangle_instance[t] = t < floor ? 1 : 0;
            const auto area_of = [](const Samples& samples, std::uint32_t instance) {
                double area = 0.0;
                for (const Sample& sample : samples.items)
                    area += sample.instance == instance ? sample.area_m2 : 0.0F;
                return area;
            };
            const Samples moved = engine->at({&pose, 1})->visible_surface(view, sonar);
            const Samples fixed = make_rays_engine(still)->visible_surface(view, sonar);
            for (const std::uint32_t instance : {0U, 1U}) {
                CHECK(area_of(fixed, instance) > 0.05);
                CHECK(std::fabs(area_of(moved, instance) / area_of(fixed, instance) - 1.0) < 1e-3);
            }
        }
    }

    TEST_CASE("moving: the octree and the slices refuse") {
        Scene shape = empty_scene();
        add_sphere(shape, {0, 0, 0}, 0.5F, add_material(shape, 1.0F), 16);
        const Scene scene = as_body(shape);
        CHECK(unsupported({.type = EngineKind::rays, .octree = {}}, scene).empty());
        CHECK(unsupported({.type = EngineKind::octree, .octree = {}}, scene) ==
              "engine: octree does not support moving objects; use engine: auto or engine: rays");
        CHECK(unsupported({.type = EngineKind::slices, .octree = {}}, scene) ==
              "engine: slices does not support moving objects; use engine: auto or engine: rays");
    }
}
