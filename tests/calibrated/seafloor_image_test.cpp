#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/model.h"
#include "support/calibrated.h"
#include "support/patches.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Material 0 is sand, 1 is steel, 2 scatters nothing.
Scene scene_of_beds() {
    Scene scene;
    Material sand{.name = "sand"};
    sand.grain_phi = 1.5;
    scene.materials = {sand,
                       {.name = "steel", .reflection = 0.8F},
                       {.name = "mirror", .lambert_db = -300.0, .slope_rms_deg = 0.0}};
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

/// sigma of sand by the formulas of the report.
double sand(double sine, double frequency_hz, double sound_speed_m_s) {
    const SeafloorScattering bed(sea_bed_of_grain_size(1.5),
                                 2.0 * pi * frequency_hz / sound_speed_m_s);
    return bed.diffuse(std::asin(sine)) + bed.specular(std::asin(sine));
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

TEST_SUITE("calibrated") {
    TEST_CASE("sea bed: the level of a floor in an imaging sonar") {
        // The energy of an image is the sum of sigma A r^-4 10^(-0.2 alpha r) over the floor, times
        // what the receiver makes of a point. A plate that faces the sonar has the latter.
        const CalibratedModel model = fan_model();
        const Scene scene = scene_of_beds();
        const auto received = [&](double range) {
            return std::pow(range, -4.0) * std::pow(10.0, -0.2 * model.absorption_db_per_m * range);
        };
        const auto sigma = [&](double sine) { return sand(sine, 4e5, model.sound_speed_m_s); };
        const double of_plate =
            total(image_of(model, scene, fan_view,
                           {square({4.0F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}, 0.001F)})) /
            (sigma(1.0) * 1e-6 * received(4.0));
        for (const float depth : {0.3F, 0.8F, 1.5F}) {
            const std::vector<Sample> floor = strip(depth);
            double expected = 0.0;
            for (const Sample& piece : floor) {
                const double range = piece.position.norm();
                expected += sigma(depth / range) * piece.area_m2 * received(range);
            }
            const double found = total(image_of(model, scene, fan_view, floor));
            CAPTURE(depth);
            CHECK(std::fabs(db_of_power(found / (expected * of_plate))) < 0.1);
        }
    }

    TEST_CASE("sea bed: a prepared model makes the image, of another scene as well") {
        const CalibratedModel model = fan_model();
        const Scene beds = scene_of_beds();
        const auto prepared =
            std::dynamic_pointer_cast<const CalibratedModel>(model.prepared(beds));
        REQUIRE(prepared != nullptr);
        Scene steel_alone;
        steel_alone.materials = {beds.materials[1]};
        for (const Scene& scene : {beds, steel_alone})
            CHECK(image_of(*prepared, scene, fan_view, strip(0.8F)) ==
                  image_of(model, scene, fan_view, strip(0.8F)));
    }

    TEST_CASE("sea bed: in a scene of many materials each scatters as if it were alone") {
        // More than the eight that a register holds.
        const CalibratedModel model = fan_model();
        Scene many;
        for (int k = 0; k < 6; ++k) {
            many.materials.push_back({.name = "plain", .lambert_db = -20.0 - k});
            many.materials.push_back({.name = "bed"});
            many.materials.back().grain_phi = 1.5 * k;
        }
        for (std::uint32_t k = 0; k < many.materials.size(); ++k) {
            Scene alone;
            alone.materials = {many.materials[k]};
            CHECK(image_of(model, many, fan_view, strip(0.8F, k)) ==
                  image_of(model, alone, fan_view, strip(0.8F, 0)));
        }
    }

    TEST_CASE("a material that scatters nothing makes an image of zeros") {
        const CalibratedModel model = fan_model();
        for (const float value : image_of(model, scene_of_beds(), fan_view, strip(0.8F, 2)))
            CHECK(std::fabs(value) < 1e-25F);
    }
}
