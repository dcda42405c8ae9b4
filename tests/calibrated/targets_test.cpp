#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "core/units.h"
#include "ping/form_image.h"
#include "support/calibrated.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "trace/target_mesh.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double slope_deg = 5.0;

constexpr EngineKind engine_kinds[] = {EngineKind::rays, EngineKind::slices, EngineKind::octree,
                                       EngineKind::automatic};

double total(const std::vector<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0);
}

double decibels(double ratio) {
    return 10.0 * std::log10(ratio);
}

/// A sonar of a kind with the beams of a usual instrument.
Sonar target_sonar(SonarKind kind) {
    SonarConfig config = calibrated(default_sonar(kind), 9e5);
    config.instrument = bare(config.instrument);
    config.range_min_m = 0.5;
    config.range_max_m = 20.0;
    config.range_bins = 400;
    config.azimuth_bins = 128;
    if (kind == SonarKind::sidescan) {
        config.elevation_deg = 6.0;
        config.instrument.beam.width_deg = 0.3;
        config.instrument.beam.tilt_deg = 30.0;
    }
    return make_sonar(config, {});
}

/// A sphere in a scene, and where it is.
struct Ball {
    Scene scene = empty_scene();
    Eigen::Vector3d centre;
    double radius;

    Ball(const Eigen::Vector3d& at, double radius_m, int sides) : centre(at), radius(radius_m) {
        const std::uint32_t metal = add_material(scene, 0.8F);
        scene.materials[metal].slope_rms_deg = slope_deg;
        add_sphere(scene, at.cast<float>(), static_cast<float>(radius_m), metal, sides);
        // A corner far away keeps the scene's bounds.
        add_quad(scene, {-40, -40, -40}, {-39, -40, -40}, {-39, -39, -40}, {-40, -39, -40}, metal);
    }
};

double energy_by(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle = {}) {
    return total(
        render_ping(sonar, scene, engine, T_world_vehicle, {}, direct_echoes_alone).intensity);
}

std::unique_ptr<VisibilityEngine> engine_of(const Scene& scene, EngineKind kind) {
    EngineSettings settings;
    settings.type = kind;
    return make_engine(scene, settings);
}

Sonar with_targets(Sonar sonar, const Scene& scene) {
    find_targets({&sonar, 1}, scene);
    return sonar;
}

/// The energy of a sphere from points on it, close together where it glints.
double energy_of_points(const Sonar& sonar, const Ball& ball, const Pose& T_world_vehicle = {}) {
    const Pose T_world_sensor = sensor_pose(sonar, T_world_vehicle, 0);
    const Eigen::Vector3d c =
        T_world_sensor.rotation.conjugate() * (ball.centre - T_world_sensor.translation);
    const Eigen::Vector3d to_sonar = -c.normalized();
    const Eigen::Vector3d across = to_sonar.unitOrthogonal();
    const Eigen::Vector3d up = to_sonar.cross(across);
    constexpr int rings = 300;
    constexpr int around = 96;
    TracedPing traced;
    traced.T_world_sensor = T_world_sensor;
    // Half of the rings lie within 5 slopes.
    const double glint = std::tan(radians(slope_deg)) * 5.0;
    const auto angle = [&](double k) {
        const double half = 0.5 * rings;
        return k < half ? glint * k / half : glint + (0.5 * pi - glint) * (k - half) / half;
    };
    for (int k = 0; k < rings; ++k) {
        const double low = angle(k);
        const double high = angle(k + 1.0);
        const double t = angle(k + 0.5);
        const double area =
            2.0 * pi * ball.radius * ball.radius * (std::cos(low) - std::cos(high)) / around;
        for (int j = 0; j < around; ++j) {
            const double turn = 2.0 * pi * (j + 0.5 * (k % 2)) / around;
            const Eigen::Vector3d n = std::cos(t) * to_sonar +
                                      std::sin(t) * (std::cos(turn) * across + std::sin(turn) * up);
            const Eigen::Vector3d p = c + ball.radius * n;
            const double height = -p.dot(n);
            if (height <= 0.0 || beam_of(sonar.settings.view, p.cast<float>()) < 0) continue;
            traced.samples.items.push_back({.position = p.cast<float>(),
                                            .edge_u = Eigen::Vector3f::Zero(),
                                            .edge_v = Eigen::Vector3f::Zero(),
                                            .normal = n.cast<float>(),
                                            .height_m = static_cast<float>(height),
                                            .area_m2 = static_cast<float>(area),
                                            .material = 0,
                                            .instance = 0});
        }
    }
    return total(form_image(traced, sonar.settings, ball.scene, {}, direct_echoes_alone).intensity);
}

constexpr SonarKind all_kinds[] = {SonarKind::imaging, SonarKind::sidescan, SonarKind::echosounder,
                                   SonarKind::scanning, SonarKind::profiling};

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("targets: the strength of spheres, any mesh, sonar and engine" *
              doctest::skip(test::sanitized)) {
        std::mt19937 random(11);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (const SonarKind kind : all_kinds) {
            const Sonar sonar = target_sonar(kind);
            for (int trial = 0; trial < 6; ++trial) {
                const double radius = 0.02 * std::pow(100.0, unit(random));
                const double range = radius + 5.0 + 9.0 * unit(random);
                // Near the axis of the beam, where the pattern bends little.
                const Pose T_world_sensor = sensor_pose(sonar, Pose{}, 0);
                const double side = kind == SonarKind::sidescan ? radians(60.0) : 0.0;
                const double azimuth = side + 0.004 * (unit(random) - 0.5);
                const Eigen::Vector3d at =
                    T_world_sensor.translation +
                    T_world_sensor.rotation *
                        Eigen::Vector3d(range * std::cos(azimuth), range * std::sin(azimuth), 0.0);
                const int sides[] = {16, 32, 96};
                const Ball ball(at, radius, sides[trial % 3]);
                const Sonar ready = with_targets(sonar, ball.scene);
                const double expected = energy_of_points(sonar, ball);
                for (const EngineKind type : engine_kinds) {
                    const double found = energy_by(ready, ball.scene, *engine_of(ball.scene, type));
                    CAPTURE(static_cast<int>(kind));
                    CAPTURE(static_cast<int>(type));
                    CAPTURE(radius);
                    CAPTURE(range);
                    CAPTURE(sides[trial % 3]);
                    CAPTURE(decibels(found / expected));
                    CHECK(std::fabs(decibels(found / expected)) < 1.0);
                }
            }
        }
    }

    // A sphere of 10 cm radius 15 m off a side-scan sonar whose two-way pattern is 9 cm wide there.
    TEST_CASE("targets: a sphere of few triangles is a sphere, however large it looks") {
        // Its highlight is seven resolution cells across, enough for an engine's samples; but these
        // have the normals of the facets.
        SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 9e5);
        config.instrument = bare(config.instrument);
        config.range_min_m = 0.5;
        config.range_max_m = 12.0;
        config.range_bins = 1200;
        config.azimuth_deg = 60.0;
        config.azimuth_bins = 512;
        const Sonar sonar = make_sonar(config, {});
        const Pose T_world_sensor = sensor_pose(sonar, Pose{}, 0);
        for (const int sides : {12, 16, 24}) {
            const Ball ball(T_world_sensor.rotation * Eigen::Vector3d(9.6, 0.1, 0.0) +
                                T_world_sensor.translation,
                            1.6, sides);
            const auto engine = engine_of(ball.scene, EngineKind::rays);
            const double found = energy_by(with_targets(sonar, ball.scene), ball.scene, *engine);
            const double exact = energy_of_points(sonar, ball);
            CAPTURE(sides);
            CHECK(std::fabs(decibels(found / exact)) < 1.0);
        }
    }

    TEST_CASE("targets: a sphere along track follows the two-way pattern, without dropouts") {
        const Sonar sonar = target_sonar(SonarKind::sidescan);
        const Ball ball({0.0, 13.0, -7.5}, 0.1, 48);
        const Sonar ready = with_targets(sonar, ball.scene);
        for (const EngineKind type : engine_kinds) {
            const auto engine = engine_of(ball.scene, type);
            for (int step = 0; step < 8; step += test::sanitized ? 7 : 1) {
                const Pose T_world_vehicle{Eigen::Quaterniond::Identity(), {0.05 * step, 0, 0}};
                const double expected = energy_of_points(sonar, ball, T_world_vehicle);
                const double found = energy_by(ready, ball.scene, *engine, T_world_vehicle);
                CAPTURE(static_cast<int>(type));
                CAPTURE(step);
                CHECK(std::fabs(decibels(found / expected)) < 1.0);
            }
        }
    }

    TEST_CASE("targets: small plates are in every ping, by the pattern at their place") {
        const Sonar sonar = target_sonar(SonarKind::sidescan);
        for (const double edge : {0.02, 0.05, 0.1}) {
            // 20 m off, turned to where the sonar is when it passes.
            const Eigen::Vector3d centre(0.0, 17.3, -10.0);
            const Eigen::Vector3d up = Eigen::Vector3d(0.0, 10.0, 17.3).normalized();
            const auto corner = [&](double along, double across) -> Eigen::Vector3f {
                return (centre + 0.5 * edge * (along * Eigen::Vector3d::UnitX() + across * up))
                    .cast<float>();
            };
            Scene scene = empty_scene();
            const std::uint32_t metal = add_material(scene, 0.8F);
            scene.materials[metal].slope_rms_deg = slope_deg;
            add_quad(scene, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), metal);
            // A floor below that gives no echo, which an engine has to sample as well.
            scene.materials.push_back({.name = "dark", .lambert_db = -200.0});
            scene.materials.back().slope_rms_deg = 0.0;
            add_floor(scene, 60.0F, -11.0F, 1, 4);
            const auto engine = engine_of(scene, EngineKind::automatic);
            const Sonar ready = with_targets(sonar, scene);
            for (int step = 0; step < 61; step += test::sanitized ? 10 : 1) {
                const Pose T_world_vehicle{Eigen::Quaterniond::Identity(),
                                           {0.01 * (step - 30), 0, 0}};
                TracedPing points;
                points.T_world_sensor = sensor_pose(sonar, T_world_vehicle, 0);
                constexpr int n = 12;
                for (int k = 0; k < n * n; ++k) {
                    const Eigen::Vector3d at =
                        corner((2.0 * (k % n) + 1.0) / n - 1.0, (2.0 * (k / n) + 1.0) / n - 1.0)
                            .cast<double>();
                    const Eigen::Vector3d p = points.T_world_sensor.rotation.conjugate() *
                                              (at - points.T_world_sensor.translation);
                    // Each ping sees the plate at the same height off its plane.
                    points.samples.items.push_back(
                        {.position = p.cast<float>(),
                         .edge_u = Eigen::Vector3f::Zero(),
                         .edge_v = Eigen::Vector3f::Zero(),
                         .normal = -p.normalized().cast<float>(),
                         .height_m = static_cast<float>(centre.norm()),
                         .area_m2 = static_cast<float>(edge * edge / (n * n)),
                         .material = 0,
                         .instance = 0});
                }
                const double expected = total(
                    form_image(points, sonar.settings, scene, {}, direct_echoes_alone).intensity);
                const double found = energy_by(ready, scene, *engine, T_world_vehicle);
                CAPTURE(edge);
                CAPTURE(step);
                CHECK(std::fabs(decibels(found / expected)) < 0.5);
            }
        }
    }

    // The highlight of a sphere of radius a has a normal distribution of RMS a s across. What a
    // wall leaves of it is the integral of that.
    TEST_CASE("targets: what a wall hides of a highlight has no echo") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const double radius = 0.3;
        const double range = 8.0;
        const double slope = std::tan(radians(slope_deg));
        const Ball open({range, 0.0, 0.0}, radius, 48);
        const double whole = energy_by(with_targets(sonar, open.scene), open.scene,
                                       *engine_of(open.scene, EngineKind::rays));
        for (const double edge : {-1.5, -0.7, 0.0, 0.4, 1.0}) {  // in units of a s
            Ball hidden({range, 0.0, 0.0}, radius, 48);
            // The wall stands at half of the range to the highlight.
            const double y = 0.5 * edge * radius * slope;
            const auto at = [&](double across, double up) {
                return Eigen::Vector3f(static_cast<float>(0.5 * (range - radius)),
                                       static_cast<float>(across), static_cast<float>(up));
            };
            add_quad(hidden.scene, at(y, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(y, 2.0), 0);
            hidden.scene.materials.push_back({.name = "dark", .lambert_db = -200.0});
            hidden.scene.materials.back().slope_rms_deg = 0.0;
            for (std::size_t t = hidden.scene.triangles.size() - 2;
                 t < hidden.scene.triangles.size(); ++t)
                hidden.scene.triangle_material[t] = 1;
            const double left = energy_by(with_targets(sonar, hidden.scene), hidden.scene,
                                          *engine_of(hidden.scene, EngineKind::rays));
            const double expected = 0.5 * std::erfc(-edge / std::sqrt(2.0));
            CAPTURE(edge);
            CHECK(left / whole == doctest::Approx(expected).epsilon(0.15));
        }
    }

    // A sphere that scatters by Lambert's rule has the echo sin^2(grazing angle) dA, that is
    // sqrt(1 - y^2 - z^2) dy dz seen from afar, in radii. Beyond y = t it is the integral of
    // pi / 2 (1 - y^2), a share of 1/2 - (3 t - t^3) / 4.
    TEST_CASE("targets: a wall hides the share of a rough sphere that lies behind it") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const double radius = 0.2;
        const double range = 10.0;
        const auto energy = [&](const Ball& ball) {
            return energy_by(with_targets(sonar, ball.scene), ball.scene,
                             *engine_of(ball.scene, EngineKind::rays));
        };
        const Ball open({range, 0.0, 0.0}, radius, 24);
        const auto without_facets = [](Ball ball) {
            ball.scene.materials[0].slope_rms_deg = 0.0;
            return ball;
        };
        const double whole = energy(without_facets(open));
        std::mt19937 random(27);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        double squares = 0.0;
        constexpr int draws = 24;
        for (int draw = 0; draw < draws; ++draw) {
            const double edge = 0.5 * uniform(random);
            const double turn = pi * uniform(random);
            Ball hidden = without_facets(open);
            // The wall stands at half of the range and is out of the image's last bins.
            const auto at = [&](double across, double up) {
                return Eigen::Vector3f(
                    static_cast<float>(0.5 * range),
                    static_cast<float>(across * std::cos(turn) - up * std::sin(turn)),
                    static_cast<float>(across * std::sin(turn) + up * std::cos(turn)));
            };
            const double y = 0.5 * edge * radius;
            hidden.scene.materials.push_back({.name = "dark", .lambert_db = -200.0});
            hidden.scene.materials.back().slope_rms_deg = 0.0;
            add_quad(hidden.scene, at(y, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(y, 2.0), 1);
            const double expected = 0.5 + 0.25 * (3.0 * edge - edge * edge * edge);
            const double off = decibels(energy(hidden) / whole / expected);
            CAPTURE(edge);
            CAPTURE(turn);
            CHECK(std::fabs(off) < 1.0);
            squares += off * off / draws;
        }
        CHECK(std::sqrt(squares) < 0.4);
    }

    TEST_CASE("targets: with speckle a small highlight is steady, and energies are right" *
              doctest::skip(test::sanitized)) {
        Sonar sonar = target_sonar(SonarKind::imaging);
        const auto with_speckle = [&](SpeckleMode mode) {
            SonarConfig config = sonar.config;
            config.instrument.speckle.mode = mode;
            return make_sonar(config, {});
        };
        for (const SpeckleMode mode : {SpeckleMode::scene, SpeckleMode::ping}) {
            const Ball small({8.0, 0.3, 0.2}, 0.1, 48);
            Ball rough({8.0, 0.3, 0.2}, 1.0, 48);
            rough.scene.materials[0].slope_rms_deg = 20.0;
            double mean = 0.0;
            constexpr int draws = 40;
            for (std::uint32_t seed = 1; seed <= draws; ++seed) {
                const auto energy = [&](const Ball& ball) {
                    return total(render_ping(with_targets(with_speckle(mode), ball.scene),
                                             ball.scene, *engine_of(ball.scene, EngineKind::rays),
                                             Pose{}, {.seed = seed, .ping = 0},
                                             {.multipath = false, .random = 1})
                                     .intensity);
                };
                CHECK(std::fabs(decibels(energy(small) / energy_of_points(sonar, small))) < 1.6);
                mean += energy(rough) / draws;
            }
            CHECK(std::fabs(decibels(mean / energy_of_points(sonar, rough))) < 1.0);
        }
    }

    TEST_CASE("targets: bodies that move and copies of a mesh are sampled where they are") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const Ball still({8.0, 0.3, 0.2}, 0.15, 32);
        const double expected = energy_by(with_targets(sonar, still.scene), still.scene,
                                          *engine_of(still.scene, EngineKind::rays));
        // The sphere about the origin of its own frame, with half of the radius for the copy.
        const Ball ball({0.0, 0.0, 0.0}, 0.15, 32);
        const Ball half({0.0, 0.0, 0.0}, 0.075, 32);
        const auto without_sphere = [&] {
            Scene scene = still.scene;
            const auto last = static_cast<std::ptrdiff_t>(scene.triangles.size() - 2);
            scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + last);
            scene.triangle_material.resize(2);
            scene.triangle_instance.erase(scene.triangle_instance.begin(),
                                          scene.triangle_instance.begin() + last);
            return scene;
        };
        const std::size_t count = ball.scene.triangles.size() - 2;
        const auto triangles = [&](const Ball& of) {
            return std::vector(of.scene.triangles.begin(),
                               of.scene.triangles.begin() + static_cast<std::ptrdiff_t>(count));
        };
        const std::vector<std::uint32_t> materials(count, 0);

        Scene moving = without_sphere();
        moving.bodies.push_back({0, ball.scene.vertices, triangles(ball), materials});
        const auto engine = engine_of(moving, EngineKind::rays);
        const Pose there{rotation_from_rpy(0.0, 0.0, 0.7), {8.0, 0.3, 0.2}};
        CHECK(energy_by(with_targets(sonar, moving), moving, *engine->at({&there, 1})) ==
              doctest::Approx(expected).epsilon(0.01));

        Scene copied = without_sphere();
        copied.shared_meshes.push_back({half.scene.vertices, triangles(half), materials});
        MeshCopy copy{.mesh = 0, .instance = 0};
        copy.T_world_mesh = Eigen::Translation3d(8.0, 0.3, 0.2) * Eigen::Scaling(2.0);
        copied.copies.push_back(copy);
        CHECK(
            energy_by(with_targets(sonar, copied), copied, *engine_of(copied, EngineKind::rays)) ==
            doctest::Approx(expected).epsilon(0.01));
    }

    TEST_CASE("targets: a scene without them has the image of its engine") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        Scene scene = empty_scene();
        add_floor(scene, 30.0F, -2.0F, add_material(scene, 0.4F), 4);
        const auto engine = engine_of(scene, EngineKind::rays);
        CHECK(render_ping(sonar, scene, *engine, Pose{}, {}).intensity ==
              render_ping(with_targets(sonar, scene), scene, *engine, Pose{}, {}).intensity);
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
            CHECK(sphere.curvature_m == doctest::Approx(2.0).epsilon(0.01));
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
