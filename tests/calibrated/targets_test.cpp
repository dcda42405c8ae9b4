#include "calibrated/target_fixtures.h"
#include "simulate/trace/target_shapes.h"
#include "simulate/water/water_ray.h"
#include "support/draws.h"

namespace {

/// A ball and a dark wall `distance_m` off, to a line `edge_m` off the axis, turned about it.
BallScene behind_wall(BallScene ball, double distance_m, double edge_m, double turn_rad) {
    const auto at = [&](double across, double up) -> Eigen::Vector3f {
        return Eigen::Vector3d(distance_m, across * std::cos(turn_rad) - up * std::sin(turn_rad),
                               across * std::sin(turn_rad) + up * std::cos(turn_rad))
            .cast<float>();
    };
    ball.scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
    add_quad(ball.scene, at(edge_m, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(edge_m, 2.0), 1);
    return ball;
}

}  // namespace

TEST_CASE("targets: the strength of spheres, any mesh, sonar and engine") {
    Uniform random(11);
    for (const SonarKind kind : {SonarKind::imaging, SonarKind::sidescan, SonarKind::echosounder,
                                 SonarKind::scanning, SonarKind::profiling}) {
        const Sonar sonar = target_sonar(kind);
        for (int trial = 0; trial < 6; ++trial) {
            const double radius = 0.02 * std::pow(100.0, random.between(0.0, 1.0));
            const double range = radius + random.between(5.0, 14.0);
            // Near the axis of the beam, where the pattern bends little.
            const Pose T_world_sensor = sensor_pose(sonar, Pose{}, 0);
            const double side = kind == SonarKind::sidescan ? radians(60.0) : 0.0;
            const double azimuth = side + random.between(-0.002, 0.002);
            const Eigen::Vector3d at =
                T_world_sensor.translation +
                T_world_sensor.rotation * (range * direction_of(azimuth, 0.0));
            const int sides[] = {16, 32, 96};
            const BallScene ball(at, radius, sides[trial % 3]);
            const double expected = energy_of_points(sonar, ball);
            for (const EngineKind type :
                 {EngineKind::rays, EngineKind::strips, EngineKind::automatic}) {
                const auto engine = engine_of(ball.scene, type);
                const double off_db = db_of_power(energy_by(sonar, ball.scene, *engine) / expected);
                CAPTURE_ALL(static_cast<int>(kind), static_cast<int>(type), radius, range,
                            sides[trial % 3]);
                CHECK(std::fabs(off_db) < 1.0);
            }
        }
    }
}

TEST_CASE("targets: a sphere of few triangles is a sphere, however large it looks") {
    // Its highlight is seven cells across: enough samples, but with the normals of the facets.
    SonarConfig config = bare_sonar(default_sonar(SonarKind::imaging), 9e5);
    set_range(config, 0.5, 12.0, 1200);
    config.azimuth_deg = 60.0;
    config.azimuth_bins = 512;
    const Sonar sonar = make_sonar(config, {});
    const Pose T_world_sensor = sensor_pose(sonar, Pose{}, 0);
    for (const int sides : {12, 16, 24}) {
        const BallScene ball(
            T_world_sensor.rotation * Eigen::Vector3d(9.6, 0.1, 0.0) + T_world_sensor.translation,
            1.6, sides);
        CAPTURE(sides);
        CHECK(std::fabs(db_of_power(energy_by_rays(sonar, ball.scene) /
                                    energy_of_points(sonar, ball))) < 1.0);
    }
}

TEST_CASE("targets: with speckle a small highlight is steady, and energies are right") {
    for (const SpeckleMode mode : {SpeckleMode::scene, SpeckleMode::ping}) {
        const Sonar sonar = target_sonar(SonarKind::imaging, mode);
        const BallScene small({8.0, 0.3, 0.2}, 0.1, 48);
        BallScene rough({8.0, 0.3, 0.2}, 1.0, 48);
        rough.scene.materials[0].slope_rms_deg = 20.0;
        double mean = 0.0;
        double squares = 0.0;
        constexpr int draws = 40;
        for (std::uint32_t seed = 1; seed <= draws; ++seed) {
            const auto energy = [&](const BallScene& ball) {
                const auto engine = engine_of(ball.scene, EngineKind::rays);
                return energy_by(sonar, ball.scene, *engine, {}, {.seed = seed, .ping = 0},
                                 {.multipath = false, .random = 1});
            };
            const double off = db_of_power(energy(small) / energy_of_points(sonar, small));
            squares += off * off / draws;
            mean += energy(rough) / draws;
        }
        // A highlight that is not steady has 6 dB.
        CHECK(std::sqrt(squares) < 0.8);
        CHECK(std::fabs(db_of_power(mean / energy_of_points(sonar, rough))) < 1.0);
    }
}

TEST_CASE("targets: with speckle they have the texture that they have without") {
    const BallScene ball({8.0, 0.3, 0.2}, 0.1, 48);
    const auto engine = engine_of(ball.scene, EngineKind::rays);
    const auto factor = [&](SpeckleMode mode) {
        SonarConfig config = target_sonar(SonarKind::imaging, mode).config;
        const auto energy = [&](double texture) {
            config.instrument.speckle.texture = texture;
            return energy_by(make_sonar(config, {}), ball.scene, *engine, {}, {.seed = 3},
                             {.multipath = false, .random = 1});
        };
        return energy(3.0) / energy(0.0);
    };
    CHECK(std::fabs(factor(SpeckleMode::none) - 1.0) > 0.1);
    CHECK(factor(SpeckleMode::scene) == approx(factor(SpeckleMode::none)).epsilon(0.01));
}

// The highlight of a sphere of radius a has a normal distribution of RMS a s across.
TEST_CASE("targets: what a wall hides of a highlight has no echo") {
    const Sonar sonar = target_sonar(SonarKind::imaging);
    const BallScene open({8.0, 0.0, 0.0}, 0.3, 48);
    const double whole = energy_by_rays(sonar, open.scene);
    for (const double edge : {-1.5, -0.7, 0.0, 0.4, 1.0}) {  // in units of a s
        // The wall stands at half of the range to the highlight.
        const double y = 0.5 * edge * 0.3 * std::tan(radians(slope_deg));
        const BallScene hidden = behind_wall(open, 0.5 * (8.0 - 0.3), y, 0.0);
        CAPTURE(edge);
        CHECK(energy_by_rays(sonar, hidden.scene) / whole ==
              approx(0.5 * std::erfc(-edge / std::sqrt(2.0))).epsilon(0.15));
    }
}

// A sphere that scatters by Lambert's rule has the echo sqrt(1 - y^2 - z^2) dy dz, in radii.
// Beyond y = t lies a share of 1/2 - (3 t - t^3) / 4.
TEST_CASE("targets: a wall hides the share of a rough sphere that lies behind it") {
    const Sonar sonar = target_sonar(SonarKind::imaging);
    BallScene open({10.0, 0.0, 0.0}, 0.2, 24);
    open.scene.materials[0].slope_rms_deg = 0.0;
    const double whole = energy_by_rays(sonar, open.scene);
    Uniform random(27);
    double squares = 0.0;
    constexpr int draws = 24;
    for (int draw = 0; draw < draws; ++draw) {
        const double edge = random.between(-0.5, 0.5);
        const double turn = random.between(-pi, pi);
        const BallScene hidden = behind_wall(open, 5.0, 0.5 * edge * 0.2, turn);
        const double expected = 0.5 + 0.25 * (3.0 * edge - edge * edge * edge);
        const double off = db_of_power(energy_by_rays(sonar, hidden.scene) / whole / expected);
        CAPTURE_ALL(edge, turn);
        CHECK(std::fabs(off) < 1.0);
        squares += off * off / draws;
    }
    CHECK(std::sqrt(squares) < 0.4);
}

TEST_CASE("targets: bodies that move and copies of a mesh are sampled where they are") {
    const Sonar sonar = target_sonar(SonarKind::imaging);
    const BallScene still({8.0, 0.3, 0.2}, 0.15, 32);
    const double expected = energy_by_rays(sonar, still.scene);
    // Spheres about the origin of their own frames, of half of the radius for the copy.
    const Scene ball = sphere_scene({0, 0, 0}, 0.15F, 0.8F, 32);
    const Scene half = sphere_scene({0, 0, 0}, 0.075F, 0.8F, 32);

    Scene moving = metal_scene();
    moving.bodies.push_back({{ball.vertices, ball.triangles, ball.triangle_material}, 0});
    const auto engine = engine_of(moving, EngineKind::rays);
    const Pose there{rotation_from_rpy(0.0, 0.0, 0.7), {8.0, 0.3, 0.2}};
    CHECK(energy_by(sonar, moving, *engine->at({&there, 1})) == approx(expected).epsilon(0.01));

    Scene copied = metal_scene();
    copied.shared_meshes.push_back({half.vertices, half.triangles, half.triangle_material});
    MeshCopy copy{.mesh = 0, .instance = 0};
    copy.T_world_mesh = Eigen::Translation3d(8.0, 0.3, 0.2) * Eigen::Scaling(2.0);
    copied.copies.push_back(copy);
    CHECK(energy_by_rays(sonar, copied) == approx(expected).epsilon(0.01));
}

TEST_CASE("targets: where sound bends they have the echo of their apparent place") {
    // A sphere looks alike from all sides, so it has the echo of one at the apparent place, times
    // the strength of sound that converges or spreads.
    const Sonar sonar = target_sonar(SonarKind::imaging);
    const Eigen::Vector3d source = sensor_pose(sonar, Pose{}, 0).translation;
    for (const double gradient : {-4.0, 0.0, 6.0}) {
        const Eigen::Vector3d at(9.0, 0.4, 0.1);
        const SoundProfile profile{
            {-50.0, 50.0}, {1500.0 - 50.0 * gradient, 1500.0 + 50.0 * gradient}, 1500.0};
        const auto appears = apparent_place(profile, source, at).value();
        const BallScene straight(source + appears.apparent, 0.15, 32);
        BallScene bent(at, 0.15, 32);
        bent.scene.sound_profile = std::make_shared<const SoundProfile>(profile);
        CAPTURE(gradient);
        const double energy = energy_by_rays(sonar, bent.scene);
        CHECK(energy ==
              approx(appears.strength * energy_by_rays(sonar, straight.scene)).epsilon(0.02));
        // A wall across the path hides it.
        CHECK(energy_by_rays(sonar, behind_wall(bent, 4.0, -2.0, 0.0).scene) < 1e-6 * energy);
    }
}

TEST_CASE("targets: a cube keeps its faces, a sphere has its radius and is closed") {
    const Scene scene = box_scene({-1, -1, -1}, {1, 1, 1}, 0.4F);
    const TargetShape cube =
        target_shape({scene.vertices, scene.triangles, scene.triangle_material});
    CHECK(cube.triangles.size() == 12);
    CHECK(cube.curvature_m == 0.0F);
    for (const TargetTriangle& triangle : cube.triangles) {
        for (const Eigen::Vector3f& normal : triangle.normals)
            CHECK((normal - triangle.normal).norm() < 1e-6F);
    }

    for (const int sides : {16, 20, 40}) {
        const Scene round = sphere_scene({3, 4, 5}, 2.0F, 0.4F, sides);
        // Each triangle once more, seen from the other side; of 20 and 40 sides in either order.
        std::vector<std::array<std::uint32_t, 3>> twice;
        for (const auto& [a, b, c] : round.triangles)
            twice.insert(twice.end(), {{a, b, c}, {a, c, b}});
        for (std::size_t k = 0; sides > 16 && k < twice.size(); k += 2 + k % 6)
            std::swap(twice[k], twice[k + 1]);
        const TargetShape sphere =
            target_shape({round.vertices, twice, std::vector<std::uint32_t>(twice.size(), 0)});
        CHECK(sphere.triangles.size() <= round.triangles.size());
        CHECK(sphere.closed == (sides == 16));
        CHECK(sphere.curvature_m == approx(2.0).epsilon(0.01));
    }
}
