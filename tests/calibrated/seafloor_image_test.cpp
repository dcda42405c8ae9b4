#include "core/decibel.h"
#include "simulate/calibrated/equation/expected_echo.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/patches.h"

namespace {

Scene scene_of(std::vector<Material> materials) {
    Scene scene;
    scene.materials = std::move(materials);
    return scene;
}

/// The image without noise and speckle of patches of `scene`.
std::vector<float> image_of(const CalibratedModel& model, const Scene& scene, const View& view,
                            const std::vector<Sample>& patches) {
    TracedPing traced;
    traced.samples.items = patches;
    return image_of_traced(model, view, traced, {}, {1, 2, 0}, scene);
}

/// A square patch, level if the normal is along z.
Sample square(const Eigen::Vector3f& at, const Eigen::Vector3f& normal, float side_m) {
    const Eigen::Vector3f u = normal.unitOrthogonal();
    return patch_of(at, normal, 0.5F * side_m * u, 0.5F * side_m * normal.cross(u));
}

constexpr View fan_view{0.6, 1.2, 3.0, 5.0, 200, 65};

CalibratedModel fan_model() {
    InstrumentConfig config = bare({});
    config.frequency_hz = 4e5;
    config.beam.width_deg = 1.0;
    return calibrated_model(config, {}, fan_view,
                            fan_sines(degrees(fan_view.azimuth_rad), fan_view.beams));
}

/// A strip of floor straight ahead, from 3.3 to 4.7 m.
std::vector<Sample> strip(float depth_m, std::uint32_t material = 0) {
    std::vector<Sample> floor;
    for (float x = 3.3F; x < 4.7F; x += 0.01F) {
        for (float y = -0.1F; y < 0.1F; y += 0.01F) {
            floor.push_back(square({x, y, -depth_m}, {0.0F, 0.0F, 1.0F}, 0.01F));
            floor.back().material = material;
        }
    }
    return floor;
}

}  // namespace

// With u = y / r a floor at the depth d has dA = r^2 / x dr du. So a bin has the echo
// sigma r^-2 / x 10^(-0.2 alpha r) times the integrals of the pattern over u and of the pulse
// over r. Both are far narrower than this varies.
TEST_CASE("sea bed: a floor has the level of the sonar equation at every angle") {
    constexpr double depth_m = 3.0;
    constexpr int beams = 256;
    Draws draws(40);
    for (const EngineKind engine : {EngineKind::rays, EngineKind::strips}) {
        SonarConfig config = bare_sonar(default_sonar(SonarKind::imaging), 4e5);
        set_fan(config, 90.0, 60.0, beams);
        set_range(config, 1.0, 21.0, 500);
        config.instrument.beam.width_deg = draws.between(0.5F, 2.0F);
        config.instrument.beam.side_lobe_db = draws.between(-35.0F, -15.0F);
        config.instrument.pulse.resolution_m = draws.between(0.04F, 0.3F);
        const Sonar sonar = make_sonar(config, {});
        const Scene scene = bed_scene(example_sand(), 60.0F, -depth_m, 100);
        const std::vector<float> image = expected_image(sonar, scene, engine);
        const View& view = sonar.settings.view;
        const double alpha = calibrated_model_of(sonar).absorption_db_per_m;
        const ExpectedEcho echo = expected_echo(sonar.config.instrument, {}, view);
        const auto expected = [&](int row, int beam) {
            const double r = view.range_min_m + (row + 0.5) * view.bin_m();
            const double u = std::sin(radians(90.0 * ((beam + 0.5) / beams - 0.5)));
            const double x = std::sqrt(r * r * (1.0 - u * u) - depth_m * depth_m);
            return scattering_strength(example_sand(), 4e5, depth_m / r) / (r * r * x) *
                   std::pow(10.0, -0.2 * alpha * r) * echo.far_integral * echo.pulse_length_m;
        };
        for (const double grazing_deg : {12.0, 15.0, 18.0, 21.0, 24.0}) {
            for (const int beam : {118, 188}) {
                const double range_m = depth_m / std::sin(radians(grazing_deg));
                const int row = static_cast<int>((range_m - 1.0) / view.bin_m());
                const double found = image_array(image, beams).block(row - 5, beam, 11, 21).sum();
                double closed = 0.0;
                for (int i = row - 5; i <= row + 5; ++i) {
                    for (int j = beam; j <= beam + 20; ++j)
                        closed += expected(i, j);
                }
                CAPTURE_ALL(grazing_deg, beam, static_cast<int>(engine));
                CHECK(std::fabs(db_of_power(found / closed)) < 0.03);
            }
        }
    }
}

TEST_CASE("sea bed: a prepared model makes the image, of another scene as well") {
    const CalibratedModel model = fan_model();
    const Material steel{.name = "steel", .reflection = 0.8F};
    const Scene beds = scene_of({{.name = "sand", .grain_phi = 1.5}, steel});
    const auto prepared = std::dynamic_pointer_cast<const CalibratedModel>(model.prepared(beds));
    REQUIRE(prepared != nullptr);
    for (const Scene& scene : {beds, scene_of({steel})})
        CHECK(image_of(*prepared, scene, fan_view, strip(0.8F)) ==
              image_of(model, scene, fan_view, strip(0.8F)));
}

TEST_CASE("sea bed: in a scene of many materials each scatters as if it were alone") {
    // More than the eight that a register holds.
    const CalibratedModel model = fan_model();
    Scene many;
    for (int k = 0; k < 6; ++k) {
        many.materials.push_back({.name = "plain", .lambert_db = -20.0 - k});
        many.materials.push_back({.name = "bed", .grain_phi = 1.5 * k});
    }
    for (std::uint32_t k = 0; k < many.materials.size(); ++k) {
        CHECK(image_of(model, many, fan_view, strip(0.8F, k)) ==
              image_of(model, scene_of({many.materials[k]}), fan_view, strip(0.8F, 0)));
    }
}
