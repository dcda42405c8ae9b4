#include <doctest/doctest.h>

#include <cmath>

#include "calibrated/decibel.h"
#include "calibrated/seafloor_scattering.h"
#include "calibrated/sediment_paths.h"
#include "calibrated/water.h"
#include "core/units.h"
#include "support/approx.h"
#include "support/calibrated.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    // A sphere of 20 cm, TS = 20 log(a / 2), d below a flat bottom of sand, h below an echosounder
    // of 12 kHz. With the ratio n of the speeds, R reflected and the attenuation b in the sediment,
    //
    //     EL = TS - 40 log(h + n d) + 20 log n + 20 log(1 - R) - 2 alpha h - 2 b d,
    //     b = 20 log(e) 2 pi f loss / (n c),
    //
    // in the range bin of h + d / n. For phi = 2 that is b = 0.45 dB/m/kHz or so, as measured in
    // sand.
    TEST_CASE("buried: the level of a sphere under a flat bottom") {
        constexpr double h = 8.0;
        constexpr double d = 0.6;
        constexpr double frequency_hz = 12e3;
        Scene scene = empty_scene();
        const std::uint32_t floor = add_material(scene, 0.3F);
        scene.materials[floor].grain_phi = 2.0;
        add_floor(scene, 30.0F, 0.0F, floor, 4);
        SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), frequency_hz);
        config.range_min_m = 1.0;
        config.range_max_m = 16.0;
        config.range_bins = 300;
        config.instrument = bare(config.instrument);
        config.instrument.pulse.resolution_m = 0.1;
        scene.instances.emplace_back("ball");
        Sonar sonar = make_sonar(config, {});
        const CalibratedModel& model = calibrated_model_of(sonar);
        Particles particles;
        Particle& ball = particles.all.emplace_back();
        ball.start_m = {0.0, 0.0, -d};
        ball.velocity_m_s = Eigen::Vector3d::Zero();
        ball.section_m2 = 0.05F * 0.05F;  // a = 0.1 m
        ball.instance = static_cast<std::uint32_t>(scene.instances.size() - 1);
        ball.buried = true;
        const Water water{};
        particles.sediments =
            sediment_paths(scene.materials, water, frequency_hz, model.absorption_db_per_m);
        const SedimentPath& sand = particles.sediments[floor];
        const double n = sand.speed_ratio;
        sonar.settings.particles = std::make_shared<const Particles>(particles);

        const auto engine = make_engine(scene, {});
        const Pose at{Eigen::Quaterniond::Identity(), {0.0, 0.0, h}};
        const TracedPing with = trace(sonar, scene, *engine, at, 0);
        sonar.settings.particles = nullptr;
        const TracedPing without = trace(sonar, scene, *engine, at, 0);
        double echo = 0.0;
        double moment = 0.0;
        double taps = 0.0;
        const auto image_of = [&](const TracedPing& traced) {
            return form_image(traced, sonar.settings, scene, {}, without_random_terms).intensity;
        };
        const std::vector<float> both = image_of(with);
        const std::vector<float> bottom = image_of(without);
        for (std::size_t k = 0; k < both.size(); ++k) {
            const double power = static_cast<double>(both[k]) - bottom[k];
            echo += power;
            moment += power * (1.0 + 15.0 * (static_cast<double>(k) + 0.5) / 300.0);
        }
        for (const float tap : model.power_taps.taps)
            taps += tap;
        REQUIRE(echo > 0.0);
        CHECK(moment / echo == test::approx(h + d / n).epsilon(2e-3));
        const double z = n * sand.density_ratio;
        const double reflected = std::pow((z - 1.0) / (z + 1.0), 2);
        const double sediment_db_per_m = 20.0 * std::log10(std::exp(1.0)) * 2.0 * pi *
                                         frequency_hz * sea_bed_of_grain_size(2.0).loss /
                                         (n * water.sound_speed_m_s);
        CHECK(sediment_db_per_m / (1e-3 * frequency_hz) > 0.3);
        CHECK(sediment_db_per_m / (1e-3 * frequency_hz) < 0.6);
        const double level = 20.0 * std::log10(0.05) - 40.0 * std::log10(h + n * d) +
                             20.0 * std::log10(n) + 20.0 * std::log10(1.0 - reflected) -
                             2.0 * model.absorption_db_per_m * h - 2.0 * sediment_db_per_m * d;
        CHECK(db_of_power(echo / taps) == test::approx(level).epsilon(0.002));
    }
}
