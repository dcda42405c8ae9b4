#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "calibrated/target_fixtures.h"
#include "support/sanitized.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

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
                const BallScene ball(at, radius, sides[trial % 3]);
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
            const BallScene ball(T_world_sensor.rotation * Eigen::Vector3d(9.6, 0.1, 0.0) +
                                     T_world_sensor.translation,
                                 1.6, sides);
            const auto engine = engine_of(ball.scene, EngineKind::rays);
            const double found = energy_by(with_targets(sonar, ball.scene), ball.scene, *engine);
            const double exact = energy_of_points(sonar, ball);
            CAPTURE(sides);
            CHECK(std::fabs(decibels(found / exact)) < 1.0);
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

    TEST_CASE("targets: with speckle a small highlight is steady, and energies are right" *
              doctest::skip(test::sanitized)) {
        Sonar sonar = target_sonar(SonarKind::imaging);
        const auto with_speckle = [&](SpeckleMode mode) {
            SonarConfig config = sonar.config;
            config.instrument.speckle.mode = mode;
            return make_sonar(config, {});
        };
        for (const SpeckleMode mode : {SpeckleMode::scene, SpeckleMode::ping}) {
            const BallScene small({8.0, 0.3, 0.2}, 0.1, 48);
            BallScene rough({8.0, 0.3, 0.2}, 1.0, 48);
            rough.scene.materials[0].slope_rms_deg = 20.0;
            double mean = 0.0;
            double squares = 0.0;
            constexpr int draws = 40;
            for (std::uint32_t seed = 1; seed <= draws; ++seed) {
                const auto energy = [&](const BallScene& ball) {
                    return total(render_ping(with_targets(with_speckle(mode), ball.scene),
                                             ball.scene, *engine_of(ball.scene, EngineKind::rays),
                                             Pose{}, {.seed = seed, .ping = 0},
                                             {.multipath = false, .random = 1})
                                     .intensity);
                };
                const double off = decibels(energy(small) / energy_of_points(sonar, small));
                squares += off * off / draws;
                mean += energy(rough) / draws;
            }
            // A highlight that is not steady has 6 dB.
            CHECK(std::sqrt(squares) < 0.8);
            CHECK(std::fabs(decibels(mean / energy_of_points(sonar, rough))) < 1.0);
        }
    }
}
