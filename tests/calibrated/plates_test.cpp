#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "calibrated/decibel.h"
#include "support/calibrated.h"
#include "support/maps.h"
#include "support/scenes.h"
#include "trace/find_coherent_faces.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double frequency_hz = 2e5;
constexpr double range_m = 20.05;  // the middle of a bin of 10 cm
constexpr double side_m = 0.1;

std::uint32_t smooth_material(Scene& scene, double roughness_m) {
    const std::uint32_t material = add_material(scene, 0.5F);
    scene.materials[material].roughness_m = roughness_m;
    return material;
}

/// A square at a range on the x axis, turned about the z axis.
Scene scene_of_plate(double turned_rad, double roughness_m = 0.0, double side = side_m) {
    Scene scene = empty_scene();
    const std::uint32_t material = smooth_material(scene, roughness_m);
    const Eigen::Vector3d u =
        0.5 * side * Eigen::Vector3d{-std::sin(turned_rad), std::cos(turned_rad), 0.0};
    const Eigen::Vector3d v{0.0, 0.0, 0.5 * side};
    const Eigen::Vector3d c{range_m, 0.0, 0.0};
    const auto at = [&](double s, double t) -> Eigen::Vector3f {
        return (c + s * u + t * v).cast<float>();
    };
    add_quad(scene, at(-1, -1), at(1, -1), at(1, 1), at(-1, 1), material, 3);
    return scene;
}

Sonar plate_sonar(SonarKind kind, SpeckleMode mode = SpeckleMode::none,
                  double frequency = frequency_hz) {
    SonarConfig config = calibrated(default_sonar(kind), frequency);
    config.azimuth_deg = 20.0;
    config.elevation_deg = 20.0;
    config.azimuth_bins = 61;
    config.range_min_m = 10.0;
    config.range_max_m = 30.0;
    config.range_bins = 200;
    config.instrument = bare(config.instrument);
    config.instrument.speckle.mode = mode;
    config.instrument.beam.width_deg = 2.0;
    config.instrument.pulse.resolution_m = 0.3;
    return make_sonar(config, {});
}

std::vector<float> image_of(Sonar sonar, const Scene& scene, EngineKind type = EngineKind::rays) {
    find_targets({&sonar, 1}, scene);
    EngineSettings settings;
    settings.type = type;
    const auto engine = make_engine(scene, settings);
    const Terms terms{.multipath = false, .random = 1};  // speckle but no noise
    // The sensor looks along x, whatever the kind of sonar.
    const TracedPing traced = trace_ping(sonar.settings, scene, *engine, Pose{}, terms);
    return form_image(traced, sonar.settings, scene, {.seed = 1, .ping = 0}, terms).intensity;
}

double peak_db(const std::vector<float>& image) {
    return db_of_power(*std::ranges::max_element(image));
}

/// The level of a plate of reflection 0.5 far away, turned by an angle.
double plate_db(const Sonar& sonar, double turned_rad) {
    const CalibratedModel& model = calibrated_model_of(sonar);
    const double b = 2.0 * pi / model.wavelength_m * side_m * std::sin(turned_rad);
    const double lobes = b == 0.0 ? 1.0 : std::sin(b) / b;
    const double amplitude = std::sqrt(0.5) * side_m * side_m * std::cos(turned_rad) * lobes /
                             (model.wavelength_m * range_m * range_m);
    return 20.0 * std::log10(std::fabs(amplitude)) - 2.0 * model.absorption_db_per_m * range_m;
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("plates: flat faces are found, the facets of a curved surface are none") {
        Scene scene = empty_scene();
        const std::uint32_t smooth = smooth_material(scene, 0.0);
        const std::uint32_t rough = add_material(scene, 0.4F);
        add_box(scene, {0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 3.0F}, smooth);
        const auto faces = find_coherent_faces(scene);
        CHECK(faces->plates.size() == 6);
        // Nine cells have one border.
        CHECK(find_coherent_faces(scene_of_plate(0.3))->plates.at(0).border.size() == 4);
        for (const ScenePlate& plate : faces->plates)
            CHECK(plate.border.size() == 4);
        add_sphere(scene, {5.0F, 0.0F, 0.0F}, 1.0F, smooth, 64);
        add_box(scene, {9.0F, 0.0F, 0.0F}, {10.0F, 2.0F, 3.0F}, rough);
        CHECK(find_coherent_faces(scene)->plates.size() == 6);
    }

    TEST_CASE("plates: on ground with maps the texel before the sonar reflects") {
        const Sonar sonar = plate_sonar(SonarKind::imaging);
        const double smooth_db = peak_db(image_of(sonar, scene_of_plate(0.0)));
        const auto mapped_db = [&](bool own_smooth, bool texel_smooth, float strength) {
            Scene scene = scene_of_plate(0.0);
            const std::uint32_t rough = add_material(scene, 0.5F);
            if (!own_smooth) scene.triangle_material.assign(scene.triangles.size(), rough);
            const TexelFrame frame = square_frame(1, 100.0);
            lay(scene,
                material_texels(frame, {texel_smooth ? 0U : rough},
                                [](int, int) { return std::uint16_t{0}; }),
                strengths(frame, [&](int, int) { return strength; }));
            return peak_db(image_of(sonar, scene));
        };
        for (const bool own_smooth : {false, true}) {
            CHECK(std::fabs(mapped_db(own_smooth, true, 1.0F) - smooth_db) < 0.01);
            CHECK(std::fabs(mapped_db(own_smooth, true, 4.0F) - smooth_db - db_of_power(4.0)) <
                  0.01);
            // A rough plate of 10 cm scatters 20 dB less.
            CHECK(mapped_db(own_smooth, false, 1.0F) < smooth_db - 15.0);
        }
    }

    TEST_CASE("plates: their level in images of three kinds, with and without speckle") {
        // lambda is 7.4 mm: L^2 / lambda is 1.35 m.
        for (const SonarKind kind :
             {SonarKind::imaging, SonarKind::echosounder, SonarKind::scanning}) {
            for (const SpeckleMode mode :
                 {SpeckleMode::none, SpeckleMode::scene, SpeckleMode::ping}) {
                const Sonar sonar = plate_sonar(kind, mode);
                for (const double turned_deg : {0.0, 0.7, 3.2, 5.3}) {
                    CAPTURE(static_cast<int>(kind));
                    CAPTURE(static_cast<int>(mode));
                    CAPTURE(turned_deg);
                    const double turned = radians(turned_deg);
                    const double found = peak_db(image_of(sonar, scene_of_plate(turned)));
                    CHECK(std::fabs(found - plate_db(sonar, turned)) < 1.0);
                }
            }
        }
    }

    TEST_CASE("plates: by every engine alike, and smooth as the sonar passes") {
        const Sonar sonar = plate_sonar(SonarKind::imaging);
        const double by_rays = peak_db(image_of(sonar, scene_of_plate(0.01)));
        for (const EngineKind type : {EngineKind::slices})
            CHECK(std::fabs(peak_db(image_of(sonar, scene_of_plate(0.01), type)) - by_rays) < 0.1);
        double before = peak_db(image_of(sonar, scene_of_plate(-0.01)));
        for (double turned = -0.009; turned < 0.0101; turned += 0.001) {
            const double now = peak_db(image_of(sonar, scene_of_plate(turned)));
            CHECK(std::fabs(now - before) < 0.3);
            before = now;
        }
    }

    TEST_CASE("plates: a wall is the image source") {
        const Sonar sonar = plate_sonar(SonarKind::echosounder);
        const double loss_db = 2.0 * calibrated_model_of(sonar).absorption_db_per_m * range_m;
        const double expected = 10.0 * std::log10(0.5 / (4.0 * range_m * range_m)) - loss_db;
        const double found = peak_db(image_of(sonar, scene_of_plate(0.0, 0.0, 12.0)));
        CHECK(std::fabs(found - expected) < 1.0);
    }

    TEST_CASE("plates: with roughness they go over to incoherent scattering") {
        // At 2 k h = 12 nothing is coherent, and the plate is one whose material has no roughness.
        const Sonar sonar = plate_sonar(SonarKind::imaging);
        Scene incoherent = scene_of_plate(0.0);
        incoherent.materials[0].roughness_m.reset();
        const std::vector<float> a = image_of(sonar, scene_of_plate(0.0, 7e-3));
        const std::vector<float> b = image_of(sonar, incoherent);
        CHECK(std::fabs(peak_db(a) - peak_db(b)) < 0.01);
        // 2 k h = 1 takes 4.34 dB.
        const double k = 2.0 * pi / calibrated_model_of(sonar).wavelength_m;
        const double smooth = peak_db(image_of(sonar, scene_of_plate(0.0)));
        const double less = peak_db(image_of(sonar, scene_of_plate(0.0, 1.0 / (2.0 * k))));
        CHECK(std::fabs(less - smooth + 4.343) < 0.5);
    }

    // The energies of the coherent and of the incoherent echo of a small plate face on, at one
    // place, have the ratio of A / lambda^2 to 1 / (8 pi s^2) + mu / R. With x = (2 k h)^2 the one
    // counts by exp(-x), the other by 1 - exp(-x).
    TEST_CASE("plates: the energy by roughness, from A / lambda to the incoherent sum") {
        std::mt19937 random(5);
        const auto number = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
        };
        constexpr SonarKind kinds[] = {SonarKind::imaging, SonarKind::echosounder,
                                       SonarKind::scanning, SonarKind::sidescan,
                                       SonarKind::profiling};
        constexpr EngineKind engines[] = {EngineKind::rays, EngineKind::slices,
                                          EngineKind::automatic};
        for (int trial = 0; trial < 20; ++trial) {
            const SonarKind kind = kinds[trial % 5];
            const EngineKind engine = engines[random() % 4];
            const double frequency = number(1e5, 9e5);
            const Sonar sonar = plate_sonar(kind, SpeckleMode::none, frequency);
            const double wavelength = calibrated_model_of(sonar).wavelength_m;
            // A sixth of the Fresnel zone at most.
            const double side = std::sqrt(number(0.02, 0.15) * wavelength * range_m);
            const double slope = std::tan(radians(number(3.0, 12.0)));
            const auto energy = [&](std::optional<double> roughness_m) {
                Scene scene = scene_of_plate(0.0, 0.0, side);
                scene.materials[0].roughness_m = roughness_m;
                scene.materials[0].slope_rms_deg = degrees(std::atan(slope));
                const std::vector<float> image = image_of(sonar, scene, engine);
                return std::accumulate(image.begin(), image.end(), 0.0);
            };
            const double incoherent = energy({});
            const double ratio = side * side / (wavelength * wavelength) /
                                 (1.0 / (8.0 * pi * slope * slope) + power_of_db(-27.0) / 0.5);
            for (const double phase : {0.0, 0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 40.0}) {
                const double roughness = phase * wavelength / (4.0 * pi);
                const double coherent = std::exp(-phase * phase);
                const double expected = coherent * ratio + 1.0 - coherent;
                const double found = energy(roughness) / incoherent;
                CAPTURE(static_cast<int>(kind));
                CAPTURE(static_cast<int>(engine));
                CAPTURE(side);
                CAPTURE(slope);
                CAPTURE(frequency);
                CAPTURE(phase);
                CHECK(std::fabs(db_of_power(found / expected)) < 1.0);
            }
        }
    }

    TEST_CASE("plates: materials without roughness keep their image next to one with it") {
        for (const SonarKind kind : {SonarKind::imaging, SonarKind::scanning}) {
            Scene scene = scene_of_plate(0.01);
            scene.materials[0].roughness_m.reset();
            add_floor(scene, 40.0F, -3.0F, add_material(scene, 0.3F), 4);
            const std::uint32_t other = add_material(scene, 0.5F);
            // Out of range, but a face of the same object.
            add_quad(scene, {90, -1, -1}, {90, 1, -1}, {90, 1, 1}, {90, -1, 1}, other, 3);
            const Sonar sonar = plate_sonar(kind, SpeckleMode::scene);
            const std::vector<float> without = image_of(sonar, scene);
            scene.materials[other].roughness_m = 0.0;
            CHECK(image_of(sonar, scene) == without);
        }
    }

    TEST_CASE("plates: half of a hidden plate has a quarter of its energy") {
        for (const double edge : {-0.01, 0.0, 0.02}) {
            Scene scene = scene_of_plate(0.0);
            scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
            const double y = 0.5 * edge;  // halfway to the plate
            const auto at = [&](double across, double up) {
                return Eigen::Vector3f(static_cast<float>(0.5 * range_m),
                                       static_cast<float>(across), static_cast<float>(up));
            };
            add_quad(scene, at(y, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(y, 1.0), 1, 3);
            const Sonar sonar = plate_sonar(SonarKind::imaging);
            const double left_db =
                peak_db(image_of(sonar, scene)) - peak_db(image_of(sonar, scene_of_plate(0.0)));
            CHECK(std::fabs(left_db - 20.0 * std::log10((0.5 * side_m + edge) / side_m)) < 2.0);
        }
    }

    TEST_CASE("plates: what is hidden has no echo") {
        Scene scene = scene_of_plate(0.0);
        add_box(scene, {12.0F, -1.0F, -1.0F}, {12.5F, 1.0F, 1.0F}, add_material(scene, 0.5F));
        const Sonar sonar = plate_sonar(SonarKind::imaging);
        const std::vector<float> image = image_of(sonar, scene);
        const std::size_t bin = 100 * 61 + 30;
        CHECK(db_of_power(image[bin] + 1e-30F) < plate_db(sonar, 0.0) - 40.0);
    }
}
