// Sound that goes through thin walls.

#include "simulate/calibrated/equation/bottom.h"
#include "simulate/reference/reference.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/maps.h"
#include "support/statistics.h"

namespace {

constexpr double frequency_hz = 4e5;
const Water water;

/// A wall of drawn material without an echo of its own.
Material drawn_wall(Draws& draws) {
    Material wall{.name = "wall", .lambert_db = -300.0, .slope_rms_deg = 0.0};
    wall.density_kg_m3 = draws.between(1000.0F, 2000.0F);
    wall.sound_speed_m_s = draws.between(1500.0F, 2500.0F);
    wall.wall_mm = draws.scale(0.05F, 5.0F);
    return wall;
}

double two_way(const Material& wall) {
    const double once = wall_transmission(wall, frequency_hz, water);
    return once * once;
}

Sonar wall_sonar(SonarKind kind, SpeckleMode speckle = SpeckleMode::none) {
    SonarConfig config = bare_sonar(default_sonar(kind), frequency_hz);
    config.instrument.speckle.mode = speckle;
    config.azimuth_deg = 60.0;
    config.azimuth_bins = 64;
    set_range(config, 0.5, 12.0, 240);
    return make_sonar(config, {});
}

/// A scene in the frame of a sonar.
struct WallScene {
    Scene scene = empty_scene();
    Pose T_world_sensor;

    explicit WallScene(const Sonar& sonar) : T_world_sensor(sensor_pose(sonar, {}, 0)) {
        scene.materials.push_back({.name = "rear", .reflection = 0.4F, .slope_rms_deg = 0.0});
    }

    std::uint32_t add(const Material& material) {
        scene.materials.push_back(material);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }

    /// A plate across the whole view.
    void add_plate(float distance_m, const Eigen::Vector3f& normal, std::uint32_t material) {
        const Eigen::Vector3f n = normal.normalized();
        const Eigen::Vector3f u = 30.0F * n.unitOrthogonal();
        const Eigen::Vector3f v = n.cross(u);
        const Eigen::Vector3f middle(distance_m, 0.0F, 0.0F);
        const auto at = [&](float along, float up) -> Eigen::Vector3f {
            return T_world_sensor.rotation.cast<float>() * (middle + along * u + up * v);
        };
        add_quad(scene, at(-1, -1), at(1, -1), at(1, 1), at(-1, 1), material, 2);
    }

    void add_ball(float distance_m, float radius_m, std::uint32_t material) {
        add_sphere(scene,
                   T_world_sensor.rotation.cast<float>() * Eigen::Vector3f(distance_m, 0.0F, 0.0F),
                   radius_m, material, 48);
    }

    /// The engine; the sonar gets the walls and the targets.
    std::unique_ptr<VisibilityEngine> prepared(Sonar& sonar, EngineKind type) const {
        prepare_for(scene, sonar);
        find_targets({&sonar, 1}, scene);
        return engine_of(scene, type);
    }

    double energy(Sonar sonar, EngineKind type) const {
        const auto engine = prepared(sonar, type);
        return total(render_ping(sonar, scene, *engine, {}, {}, direct_echoes_alone).intensity);
    }
};

struct Setting {
    SonarKind kind;
    EngineKind engine;
};
constexpr Setting settings[] = {{SonarKind::imaging, EngineKind::rays},
                                {SonarKind::imaging, EngineKind::strips},
                                {SonarKind::echosounder, EngineKind::rays}};

}  // namespace

// Waves that go to and fro in the wall add up to (1 - r^2) / (1 - r^2 e^(2 i k d)) of the
// amplitude, with r = (z - z_w) / (z + z_w).
TEST_CASE("thin walls: transmission is that of the waves in the wall") {
    Draws draws(1);
    for (int n = 0; n < 100; ++n) {
        const Material wall = drawn_wall(draws);
        const double hz = draws.scale(1e4F, 3e6F);
        const double z = wall.density_kg_m3 * wall.sound_speed_m_s;
        const double z_w = water.density_kg_m3 * water.sound_speed_m_s;
        const double r = (z - z_w) / (z + z_w);
        const double kd = 2.0 * pi * hz / wall.sound_speed_m_s * 1e-3 * *wall.wall_mm;
        const double expected =
            std::norm((1.0 - r * r) / (1.0 - r * r * std::polar(1.0, 2.0 * kd)));
        CHECK(wall_transmission(wall, hz, water) == approx(expected));

        Material window = wall;
        window.wall_mm = 1e3 * draws.whole(1, 5) * wall.sound_speed_m_s / (2.0 * hz);
        CHECK(wall_transmission(window, hz, water) == approx(1.0));
        window.wall_mm = 1e3 * (0.5 * draws.whole(1, 5) + 0.25) * wall.sound_speed_m_s / hz;
        const double ratio = z / z_w;
        CHECK(wall_transmission(window, hz, water) ==
              approx(4.0 / ((ratio + 1.0 / ratio) * (ratio + 1.0 / ratio))));
    }
    // The mass law of a thin heavy wall: the mass per area alone counts.
    const Material steel{
        .name = "steel", .density_kg_m3 = 7850.0, .sound_speed_m_s = 5890.0, .wall_mm = 0.05};
    const double mass = 2.0 * pi * frequency_hz * 5e-5 * 7850.0 / (2.0 * 997.0 * 1480.0);
    CHECK(wall_transmission(steel, frequency_hz, water) ==
          approx(1.0 / (1.0 + mass * mass)).epsilon(0.01));
    CHECK(wall_transmission({.name = "solid"}, frequency_hz, water) == 0.0);
}

// A closed body takes away a part of the echo behind it, and two walls give T^4 of it back. The
// bodies are targets or large enough for an engine.
TEST_CASE("thin walls: a shadow holds T^4 of the echo without the body") {
    for (const Setting& setting : settings) {
        const Sonar sonar = wall_sonar(setting.kind);
        for (std::uint32_t n = 0; n < 4; ++n) {
            Draws draws(10 + n);
            const Material wall = drawn_wall(draws);
            Material solid = wall;
            solid.wall_mm.reset();
            const float ball_m = draws.between(2.0F, 4.0F);
            const float radius_m = draws.scale(0.15F, 0.6F);
            WallScene open(sonar);
            open.add_plate(ball_m + 2.0F, -Eigen::Vector3f::UnitX(), 0);
            WallScene thin = open;
            thin.add_ball(ball_m, radius_m, thin.add(wall));
            WallScene opaque = open;
            opaque.add_ball(ball_m, radius_m, opaque.add(solid));
            const double whole = open.energy(sonar, setting.engine);
            const double lit = opaque.energy(sonar, setting.engine);
            const double back = thin.energy(sonar, setting.engine) - lit;
            const double expected = two_way(wall) * two_way(wall) * (whole - lit);
            CAPTURE_ALL(name_of(setting.kind), static_cast<int>(setting.engine), n);
            CHECK(std::fabs(back - expected) < 0.01 * (whole - lit));
        }
    }
}

// Pieces of a small bottle overlap, so the bundles through them meet the same surface twice.
// The mean may be off by four standard errors.
TEST_CASE("thin walls: speckle keeps the mean echo of a body in a bottle") {
    constexpr std::uint64_t seeds = 400;
    Draws draws(30);
    const Material wall = drawn_wall(draws);
    for (const float radius_m : {0.05F, 0.2F}) {
        double expected = 0.0;
        for (const SpeckleMode mode : {SpeckleMode::none, SpeckleMode::scene, SpeckleMode::ping}) {
            Sonar sonar = wall_sonar(SonarKind::imaging, mode);
            WallScene bottle(sonar);
            bottle.add_ball(4.0F, radius_m, bottle.add(wall));
            bottle.add_ball(4.0F, 0.6F * radius_m, 0);
            const auto engine = bottle.prepared(sonar, EngineKind::rays);
            const auto energy_of = [&](std::uint64_t seed) {
                return total(render_ping(sonar, bottle.scene, *engine, {}, {seed, 0}).intensity);
            };
            if (mode == SpeckleMode::none) {
                expected = energy_of(0);
                CHECK(energy_of(1) == expected);
                continue;
            }
            std::vector<double> energies;
            for (std::uint64_t seed = 0; seed < seeds; ++seed)
                energies.push_back(energy_of(seed));
            CAPTURE_ALL(radius_m, static_cast<int>(mode));
            CHECK(std::fabs(mean(energies) - expected) < 4.0 * standard_error(energies));
            CHECK(standard_error(energies) < 0.06 * expected);
        }
    }
}

// Front and back are Lambert's: the integral of mu cos^2 r^-4 10^(-0.2 alpha r), and T^2 of it.
TEST_CASE("thin walls: the back of a sphere has its echo at every range") {
    constexpr double radius_m = 0.3;
    Draws draws(31);
    for (const EngineKind engine : {EngineKind::rays, EngineKind::strips}) {
        Material wall = drawn_wall(draws);
        wall.lambert_db = -20.0;
        Material solid = wall;
        solid.wall_mm.reset();
        for (const float distance_m : {3.0F, 6.0F, 9.0F, 11.0F}) {
            const Sonar sonar = wall_sonar(SonarKind::imaging);
            const auto energy = [&](const Material& material) {
                WallScene ball(sonar);
                ball.add_ball(distance_m, radius_m, ball.add(material));
                return ball.energy(sonar, engine);
            };
            const double front = energy(solid);
            const double back = energy(wall) - front;
            const double alpha = calibrated_model_of(sonar).absorption_db_per_m;
            double sums[2] = {};
            constexpr int steps = 4000;
            for (int k = 0; k < steps; ++k) {
                const double z = radius_m * (2.0 * (k + 0.5) / steps - 1.0);
                const double r =
                    std::sqrt(distance_m * distance_m + radius_m * radius_m - 2.0 * distance_m * z);
                const double cosine = (distance_m * z - radius_m * radius_m) / (radius_m * r);
                sums[cosine > 0.0 ? 0 : 1] +=
                    cosine * cosine * std::pow(r, -4.0) * std::pow(10.0, -0.2 * alpha * r);
            }
            CAPTURE_ALL(distance_m, static_cast<int>(engine));
            CHECK(back / front == approx(two_way(wall) * sums[1] / sums[0]).epsilon(0.02));
        }
    }
}

// The rear plate has a map. Without the sound through walls the error is a multiple of this.
TEST_CASE("thin walls: images agree with the reference's points") {
    for (const Setting& setting : settings) {
        Sonar sonar = wall_sonar(setting.kind);
        Draws draws(20);
        Material wall = drawn_wall(draws);
        wall.lambert_db = -20.0;
        WallScene bottle(sonar);
        bottle.add_plate(5.0F, {-1.0F, 0.2F, 0.4F}, 0);
        bottle.add_plate(3.0F, {-1.0F, -0.1F, 0.1F}, bottle.add(wall));
        bottle.add_ball(2.0F, 0.3F, 1);
        bottle.scene.maps = std::make_shared<const GroundMaps>(
            std::nullopt,
            strengths(square_frame(40, 16.0), [&](int, int) { return draws.scale(1.0F, 4.0F); }),
            std::vector<char>{1});
        const auto engine = bottle.prepared(sonar, setting.engine);
        const Reference reference =
            cast_energy_reference(Caster(bottle.scene), bottle.scene, sonar.settings,
                                  bottle.T_world_sensor, {0.02, 16.0, 4'000'000});
        const auto error = [&] {
            const Ping ping =
                render_ping(sonar, bottle.scene, *engine, {}, {}, direct_echoes_alone);
            return image_error(ping.intensity, reference.intensity, reference.scored).relative_l1;
        };
        CAPTURE_ALL(name_of(setting.kind), static_cast<int>(setting.engine), reference.noise);
        const double through = error();
        CHECK(through < 0.02 + reference.noise);
        sonar.settings.wall_transmissions.clear();
        CHECK(error() > 4.0 * through);
    }
}
