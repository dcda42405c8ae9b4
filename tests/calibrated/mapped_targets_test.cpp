#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "ping/form_image.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/maps.h"
#include "support/sanitized.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A small plate that faces a side-scan 20 m away, in water.
struct MappedPlate {
    Scene scene = empty_scene();
    std::array<Eigen::Vector3d, 2> half;  ///< half edges
    Eigen::Vector3d centre{0.0, 17.3, -10.0};
    std::array<std::uint32_t, 2> materials;

    explicit MappedPlate(double edge_m) {
        for (const float reflection : {0.1F, 0.4F}) {
            const std::uint32_t made = add_material(scene, reflection);
            scene.materials[made].slope_rms_deg = 0.0;
            scene.materials[made].lambert_db = 10.0 * std::log10(static_cast<double>(reflection));
            materials[reflection > 0.2F ? 1 : 0] = made;
        }
        half = {0.5 * edge_m * Eigen::Vector3d::UnitX(),
                0.5 * edge_m * Eigen::Vector3d(0.0, 10.0, 17.3).normalized()};
        const auto corner = [&](double along, double up) -> Eigen::Vector3f {
            return place(along, up).cast<float>();
        };
        add_quad(scene, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), materials[0]);
        // Keeps the scene's bounds.
        scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
        add_floor(scene, 60.0F, -11.0F, 2, 4);
    }

    Eigen::Vector3d place(double along, double up) const {
        return centre + along * half[0] + up * half[1];
    }
};

/// The energy of points on the plate, each with the material and the strength of its texel.
double energy_of_texels(const MappedPlate& plate, const Sonar& sonar, const Pose& pose) {
    TracedPing points;
    points.T_world_sensor = pose;
    constexpr int n = 80;
    const double area = 4.0 * plate.half[0].norm() * plate.half[1].norm() / (n * n);
    for (int k = 0; k < n * n; ++k) {
        const Eigen::Vector3d at =
            plate.place((2.0 * (k % n) + 1.0) / n - 1.0, (2.0 * (k / n) + 1.0) / n - 1.0);
        const Eigen::Vector3d p = pose.rotation.conjugate() * (at - pose.translation);
        const MappedPoint texel = plate.scene.maps->at(0, plate.materials[0], at.head<2>());
        points.samples.items.push_back({.position = p.cast<float>(),
                                        .edge_u = Eigen::Vector3f::Zero(),
                                        .edge_v = Eigen::Vector3f::Zero(),
                                        .normal = -p.normalized().cast<float>(),
                                        .height_m = static_cast<float>(plate.centre.norm()),
                                        .area_m2 = static_cast<float>(area),
                                        .material = texel.material,
                                        .instance = 0,
                                        .strength = texel.strength});
    }
    const std::vector<float> image =
        form_image(points, sonar.settings, plate.scene, {}, direct_echoes_alone).intensity;
    return std::accumulate(image.begin(), image.end(), 0.0);
}

/// Maps whose texels are drawn one by one: 0 to 12 dB, and two materials.
void apply_drawn_texels(MappedPlate& plate, double texel_m, Draws& draws) {
    constexpr int n = 100;
    // The frame lies around the plate.
    TexelFrame frame = square_frame(n, n * texel_m);
    frame.corner_m += plate.centre.head<2>();
    const auto bright = [&](int, int) { return static_cast<std::uint16_t>(draws.whole(0, 1)); };
    const auto factor = [&](int, int) {
        return static_cast<float>(std::pow(10.0, static_cast<double>(draws.between(0.0F, 1.2F))));
    };
    auto of_materials = material_texels(frame, {plate.materials[0], plate.materials[1]}, bright);
    // They lie on the plate, not on the floor.
    const std::vector<char> on{1, 0};
    plate.scene.maps =
        std::make_shared<const GroundMaps>(std::move(of_materials), strengths(frame, factor), on);
}

}  // namespace

TEST_SUITE("calibrated") {
    // An engine's samples miss a plate that is smaller than a resolution cell in some pings.
    TEST_CASE("targets: with maps they are in every ping, with the power of their texels") {
        SonarConfig config = calibrated(default_sonar(SonarKind::sidescan), 9e5);
        config.instrument = bare(config.instrument);
        config.range_min_m = 0.5;
        config.range_max_m = 20.5;
        config.range_bins = 400;
        config.elevation_deg = 6.0;
        config.instrument.beam.width_deg = 0.3;
        config.instrument.beam.tilt_deg = 30.0;
        Draws draws(31);
        for (int draw = 0; draw < (test::sanitized ? 1 : 6); ++draw) {
            const double edge = static_cast<double>(draws.between(0.03F, 0.12F));
            const double texel = edge * static_cast<double>(draws.between(0.05F, 0.8F));
            MappedPlate plate(edge);
            apply_drawn_texels(plate, texel, draws);
            Sonar sonar = make_sonar(config, {});
            find_targets({&sonar, 1}, plate.scene);
            const auto engine =
                make_engine(plate.scene, {.type = EngineKind::automatic, .octree = {}});
            for (int step = 0; step < 9; ++step) {
                const Pose vehicle{Eigen::Quaterniond::Identity(), {0.05 * (step - 4), 0, 0}};
                const double expected =
                    energy_of_texels(plate, sonar, sensor_pose(sonar, vehicle, 0));
                const std::vector<float> image =
                    render_ping(sonar, plate.scene, *engine, vehicle, {}, direct_echoes_alone)
                        .intensity;
                const double found = std::accumulate(image.begin(), image.end(), 0.0);
                CAPTURE(edge);
                CAPTURE(texel);
                CAPTURE(step);
                // The texels of a triangle are those of a parallelogram with its area: at most 0.51
                // dB in these draws. The bound is chosen.
                CHECK(std::fabs(10.0 * std::log10(found / expected)) < 0.7);
            }
        }
    }
}
