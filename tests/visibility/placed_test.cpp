#include "simulate/visibility/rays/rays_engine.h"
#include "support/draws.h"

// Copies of shared meshes, and bodies that move.

namespace {

/// A sphere of radius 1 m as a mesh that is placed.
Scene unit_sphere() {
    return sphere_scene({0, 0, 0}, 1.0F, 1.0F, 512);
}

/// A scene that holds only copies of a sphere.
Scene spheres(std::span<const Eigen::Affine3d> T_world_sphere, const Eigen::Vector3d& origin) {
    const Scene shape = unit_sphere();
    Scene scene = empty_scene(origin);
    scene.materials = shape.materials;
    scene.shared_meshes.push_back({shape.vertices, shape.triangles, shape.triangle_material});
    scene.instances.assign(T_world_sphere.size(), "sphere");
    scene.instance_classes.assign(T_world_sphere.size(), "");
    for (std::size_t k = 0; k < T_world_sphere.size(); ++k)
        scene.copies.push_back({0, static_cast<std::uint32_t>(k), T_world_sphere[k]});
    return scene;
}

Eigen::Affine3d placed(const Eigen::Vector3d& position, double scale, double turn) {
    return Eigen::Translation3d(position) * rotation_from_rpy(turn, 0.3, -turn) *
           Eigen::Scaling(scale);
}

/// The first surface that a ray along x meets.
Intersection met_along_x(const VisibilityEngine& engine, const Eigen::Vector3d& from) {
    const Pose sonar{.translation = from};
    const Ray ray{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitX()};
    Intersection hit{};
    engine.intersect(sonar, {&ray, 1}, {&hit, 1});
    return hit;
}

}  // namespace

TEST_CASE("copies: every copy of a sphere is met where it stands, in its own size") {
    // The origin is far from the world's, where floats are a quarter of a metre apart.
    const Eigen::Vector3d origin(4e6, 5e6, 0.0);
    std::vector<Eigen::Affine3d> places;
    for (int k = 0; k < 20; ++k)
        places.push_back(
            placed(origin + Eigen::Vector3d(3.0 + 0.2 * k, 5.0 * k, 0.0), 0.2 + 0.1 * k, 0.4 * k));
    const Scene scene = spheres(places, origin);
    const auto engine = make_rays_engine(scene);
    for (int k = 0; k < 20; ++k) {
        // A ray along x that passes the centre at 0.3 radii meets the sphere sqrt(1 - 0.3^2)
        // radii before it. Facets lie at most r (1 - cos(pi / 512)) = 1.9e-5 r inside.
        const double r = 0.2 + 0.1 * k;
        const double along = std::sqrt(1.0 - 0.09);
        const Intersection hit =
            met_along_x(*engine, origin + Eigen::Vector3d(0.0, 5.0 * k + 0.3 * r, 0.0));
        CHECK(std::fabs(hit.distance_m - (3.0 + 0.2 * k - along * r)) < 5e-5 * r + 2e-5);
        CHECK((hit.normal.cast<double>() - Eigen::Vector3d(-along, 0.3, 0.0)).norm() < 0.02);
        CHECK(std::fabs(hit.normal.norm() - 1.0F) < 1e-5F);
        CHECK(hit.instance == static_cast<std::uint32_t>(k));
    }
}

TEST_CASE("moving: a sphere that flies past is met where it is, a copy of it where it stands") {
    const Scene shape = unit_sphere();
    const std::array still{placed({6.0, 40.0, 0.0}, 1.0, 0.0)};
    Scene scene = spheres(still, Eigen::Vector3d::Zero());
    scene.instances.emplace_back("body");
    scene.instance_classes.emplace_back("");
    scene.bodies.push_back({{shape.vertices, shape.triangles, shape.triangle_material}, 1});
    const auto engine = make_rays_engine(scene);
    const auto check_copy = [](const VisibilityEngine& now) {
        const Intersection copy = met_along_x(now, {0.0, 40.0, 0.0});
        CHECK(std::fabs(copy.distance_m - 5.0F) < 1e-3F);
        CHECK(copy.instance == 0);
    };
    // A ray from the origin along x meets a sphere at (a, b, 0) at a - sqrt(1 - b^2). The
    // facets are 19 um inside, along the ray at most 2.6 times as much.
    for (int k = -9; k <= 9; ++k) {
        const double b = 0.1 * k;
        const double a = 5.0 + 0.1 * k;
        const Pose pose{rotation_from_rpy(0.3 * k, 0.2, 0.1 * k), {a, b, 0.0}};
        const auto now = engine->at({&pose, 1});
        const Intersection hit = met_along_x(*now, {0, 0, 0});
        const double expected = a - std::sqrt(1.0 - b * b);
        CHECK(std::fabs(hit.distance_m - expected) < 1e-4);
        const Eigen::Vector3d normal = Eigen::Vector3d(expected, 0, 0) - pose.translation;
        CHECK((hit.normal.cast<double>() - normal).norm() < 0.02);
        CHECK(hit.instance == 1);
        check_copy(*now);
    }
    check_copy(*engine);
    // A ray meets nothing before the body is placed, nor next to it.
    CHECK(std::isinf(met_along_x(*engine, {0, 0, 0}).distance_m));
    const Pose beside{.translation = {5.0, 1.1, 0.0}};
    CHECK(std::isinf(met_along_x(*engine->at({&beside, 1}), {0, 0, 0}).distance_m));
}

TEST_CASE("placed: strips see bodies and copies as the same surface among the scene's own") {
    // Spheres and boxes at drawn places, between which there is shadow, before a wall: each as
    // triangles of the scene, as a body and as a copy with a scale. Sums of area and of place by
    // instance and beam agree to a share of the whole; triangles are sorted differently.
    Draws draws(11);
    const Eigen::Vector3d origin(4e6, 5e6, -100.0);
    const View view{radians(70.0), radians(40.0), 0.2, 15.0, 128, 48, 0.03};
    for (int trial = 0; trial < 4; ++trial) {
        Scene own = empty_scene(origin);
        add_rectangle(own, {12, -9, -9}, {12, 9, 9}, add_material(own, 1.0F));
        Scene placed_scene = own;
        std::vector<Pose> poses;
        for (int k = 0; k < 6; ++k) {
            Scene shape = sphere_scene({0, 0, 0}, 0.4F, 1.0F, 24);
            if (k % 3 == 0) add_box(shape, {-0.3F, -0.5F, -0.2F}, {0.3F, 0.5F, 0.9F}, 0);
            const auto instance = static_cast<std::uint32_t>(own.instances.size());
            const double scale = k % 2 == 0 ? 1.0 : 0.5 + 0.2 * k;
            const Eigen::Affine3d T = placed(
                origin + Eigen::Vector3d(6.0, 0.0, 0.0) + 3.0 * draws.in_ball().cast<double>(),
                scale, 0.7 * k);
            const Eigen::Affine3d T_local = Eigen::Translation3d(-origin) * T;
            const auto first = static_cast<std::uint32_t>(own.vertices.size());
            for (const Eigen::Vector3f& vertex : shape.vertices)
                own.vertices.emplace_back((T_local * vertex.cast<double>()).cast<float>());
            for (const auto& [a, b, c] : shape.triangles)
                own.triangles.push_back({first + a, first + b, first + c});
            own.triangle_material.resize(own.triangles.size(), 0);
            own.triangle_instance.resize(own.triangles.size(), instance);
            for (Scene* scene : {&own, &placed_scene}) {
                scene->instances.emplace_back("thing");
                scene->instance_classes.emplace_back("");
            }
            if (k % 2 == 0) {
                placed_scene.bodies.push_back(
                    {{shape.vertices, shape.triangles, shape.triangle_material}, instance});
                poses.push_back({Eigen::Quaterniond(T.linear()), T.translation()});
            } else {
                placed_scene.copies.push_back(
                    {static_cast<std::uint32_t>(placed_scene.shared_meshes.size()), instance, T});
                placed_scene.shared_meshes.push_back(
                    {shape.vertices, shape.triangles, shape.triangle_material});
            }
        }
        const auto sums = [&](const VisibilityEngine& engine) {
            const Samples samples = engine.visible_surface(view, {{1, 0, 0, 0}, origin});
            Eigen::ArrayXXd out = Eigen::ArrayXXd::Zero(view.beams, 4 * 7);
            for (int j = 0; j < view.beams; ++j) {
                for (const Sample& sample : samples.beam(j)) {
                    const Eigen::Array3d at = sample.position.cast<double>().array();
                    out.row(j).segment<3>(4 * sample.instance) += sample.area_m2 * at.transpose();
                    out(j, 4 * sample.instance + 3) += sample.area_m2 * sample.height_m;
                }
            }
            return out;
        };
        const Eigen::ArrayXXd expected = sums(*engine_of(own, EngineKind::automatic));
        const Eigen::ArrayXXd found =
            sums(*engine_of(placed_scene, EngineKind::automatic)->at(poses));
        CHECK((found - expected).abs().sum() < 1e-3 * expected.abs().sum());
        CHECK((expected.col(4 * 6 + 3) > 0.0).any());
    }
}
