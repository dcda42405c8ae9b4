#include "calibrated/target_fixtures.h"
#include "support/draws.h"
#include "support/maps.h"

namespace {

/// A small plate of material 0 that faces a side-scan 20 m away, over a floor without an echo.
struct PlateScene {
    Scene scene = empty_scene();
    Eigen::Vector3d centre{0.0, 17.3, -10.0};
    std::array<Eigen::Vector3d, 2> half;  ///< half edges

    PlateScene(double edge_m, const std::vector<Material>& materials) {
        half = {0.5 * edge_m * Eigen::Vector3d::UnitX(),
                0.5 * edge_m * Eigen::Vector3d(0.0, 10.0, 17.3).normalized()};
        const auto corner = [&](double along, double up) -> Eigen::Vector3f {
            return place(along, up).cast<float>();
        };
        scene.materials = materials;
        scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
        add_quad(scene, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), 0);
        add_floor(scene, 60.0F, -11.0F, static_cast<std::uint32_t>(materials.size()), 4);
    }

    Eigen::Vector3d place(double along, double up) const {
        return centre + along * half[0] + up * half[1];
    }
};

/// The energy of points on the plate, each with the material and the strength of its texel.
double energy_of_texels(const PlateScene& plate, const Sonar& sonar, const Pose& T_world_vehicle) {
    TracedPing points;
    const Pose pose = sensor_pose(sonar, T_world_vehicle, 0);
    points.T_world_sensor = pose;
    constexpr int n = 80;
    const double area = 4.0 * plate.half[0].norm() * plate.half[1].norm() / (n * n);
    for (int k = 0; k < n * n; ++k) {
        const Eigen::Vector3d at =
            plate.place((2.0 * (k % n) + 1.0) / n - 1.0, (2.0 * (k / n) + 1.0) / n - 1.0);
        const Eigen::Vector3d p = pose.rotation.conjugate() * (at - pose.translation);
        Sample& point = points.samples.items.emplace_back(point_facing(p.cast<float>(), area));
        // Each ping sees the plate at the same height off its plane.
        point.height_m = static_cast<float>(plate.centre.norm());
        if (!plate.scene.maps) continue;
        const MappedPoint texel = plate.scene.maps->at(0, 0, at.head<2>());
        point.material = texel.material;
        point.strength = texel.strength;
    }
    return total(
        form_image(points, sonar.settings, plate.scene, {}, direct_echoes_alone).intensity);
}

/// The greatest difference of `pings` pings, as the sonar passes, from the points, dB.
double greatest_error_db(const PlateScene& plate, int pings, double step_m) {
    const Sonar sonar = target_sonar(SonarKind::sidescan);
    const auto engine = engine_of(plate.scene, EngineKind::automatic);
    double worst = 0.0;
    for (int ping = 0; ping < pings; ++ping) {
        const Pose vehicle{.translation = {step_m * (ping - pings / 2), 0, 0}};
        const double found = energy_by(sonar, plate.scene, *engine, vehicle);
        const double expected = energy_of_texels(plate, sonar, vehicle);
        worst = std::max(worst, std::fabs(db_of_power(found / expected)));
    }
    return worst;
}

/// Maps whose texels are drawn one by one: 0 to 12 dB, and two materials.
void apply_drawn_texels(PlateScene& plate, double texel_m, Draws& draws) {
    constexpr int n = 100;
    TexelFrame frame = square_frame(n, n * texel_m);
    frame.corner_m += plate.centre.head<2>();
    const auto bright = [&](int, int) { return static_cast<std::uint16_t>(draws.whole(0, 1)); };
    const auto factor = [&](int, int) {
        return static_cast<float>(std::pow(10.0, static_cast<double>(draws.between(0.0F, 1.2F))));
    };
    auto materials = material_texels(frame, {0, 1}, bright);
    // They lie on the plate, not on the floor.
    const std::vector<char> on{1, 0};
    plate.scene.maps =
        std::make_shared<const GroundMaps>(std::move(materials), strengths(frame, factor), on);
}

}  // namespace

// An engine's samples miss a plate that is smaller than a resolution cell in some pings.
TEST_CASE("targets: small plates are in every ping, by the pattern at their place") {
    for (const double edge : {0.02, 0.05, 0.1}) {
        CAPTURE(edge);
        const PlateScene plate(edge,
                               {{.name = "metal", .reflection = 0.8F, .slope_rms_deg = slope_deg}});
        CHECK(greatest_error_db(plate, 61, 0.01) < 0.5);
    }
}

TEST_CASE("targets: with maps they are in every ping, with the power of their texels") {
    Draws draws(31);
    for (int draw = 0; draw < 6; ++draw) {
        const double edge = draws.between(0.03F, 0.12F);
        const double texel = edge * draws.between(0.05F, 0.8F);
        CAPTURE_ALL(edge, texel);
        PlateScene plate(edge, {{.name = "dim", .lambert_db = -10.0, .slope_rms_deg = 0.0},
                                {.name = "bright", .lambert_db = -4.0, .slope_rms_deg = 0.0}});
        apply_drawn_texels(plate, texel, draws);
        // A triangle has the texels of a parallelogram with its area. The bound is chosen.
        CHECK(greatest_error_db(plate, 9, 0.05) < 0.7);
    }
}

TEST_CASE("targets: a rod across a thin view has one level, however it is cut") {
    SonarConfig config = target_sonar(SonarKind::sidescan).config;
    config.elevation_deg = 0.25;
    const Sonar sonar = make_sonar(config, {});
    const auto level = [&](int pieces, double x) {
        Scene scene = metal_scene();
        scene.instances.emplace_back("rod");
        const auto at = [&](int k) -> Eigen::Vector3f {
            return Eigen::Vector3d(1.2 * k / pieces - 0.6, 17.3, -10.0).cast<float>();
        };
        for (int k = 0; k < pieces; ++k)
            add_bar(scene, at(k), at(k + 1), 0.025F, 24, false, 0);
        const auto engine = engine_of(scene, EngineKind::automatic);
        return db_of_power(energy_by(sonar, scene, *engine, {.translation = {x, 0, 0}}));
    };
    const double expected = level(400, 0.0);
    for (const int pieces : {1, 4, 20}) {
        for (const double x : {0.0, 0.011, 0.05, 0.11}) {
            CAPTURE_ALL(pieces, x);
            CHECK(std::fabs(level(pieces, x) - expected) < 0.3);
        }
    }
}
