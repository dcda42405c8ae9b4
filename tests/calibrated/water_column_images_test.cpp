#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/piston.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    // Bins 4 apart, two resolutions, hardly overlap. 45 of them in each of 60 pings: the mean of
    // 2,700 exponential draws is within 7 % (3.6 sigma).
    TEST_CASE("water: its speckle is exponential in power, new in every ping, keyed by the seed") {
        const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
        const CalibratedModel quiet = sounder(SpeckleMode::none);
        const CalibratedModel model = sounder(SpeckleMode::scene);
        const std::vector<float> expected = water_image(quiet, view);
        std::vector<double> powers;
        for (std::uint32_t ping = 0; ping < 60; ++ping) {
            const std::vector<float> image = water_image(model, view, {7, 2, ping});
            for (int row = 10; row < 190; row += 4)
                powers.push_back(image[row] / expected[row]);
        }
        CHECK(test::mean(powers) == test::approx(1.0).epsilon(0.07));
        CHECK(ks_p_value(powers, [](double x) { return 1.0 - std::exp(-x); }) > 1e-3);
        CHECK(water_image(model, view, {7, 2, 0}) == water_image(model, view, {7, 2, 0}));
        CHECK(water_image(model, view, {7, 2, 0}) != water_image(model, view, {8, 2, 0}));
        CHECK(water_image(model, view, {7, 2, 0}) != water_image(model, view, {7, 2, 1}));
    }

    // The sonar is 3 m below the surface and looks straight down: the layer from 8 to 11 m of depth
    // lies between 5 and 8 m of range, but for the edge of a 7 degree beam, 0.02 m.
    TEST_CASE("water: a layer is at its depth, and the water ends at the bottom") {
        SonarConfig config = calibrated(kind_of(SonarKind::echosounder).keys.defaults, 2e5);
        config.opening_deg = 40.0;
        config.range_min_m = 2.0;
        config.range_max_m = 22.0;
        config.range_bins = 200;
        config.instrument = instrument_of(Aperture::piston, 7.0);
        WaterConfig water;
        water.layers.push_back({.depth_m = {8.0, 11.0}, .scattering_db_per_m3 = strength_db});
        const Sonar layered = make_sonar(config, {}, water);
        const Sonar full = make_sonar(config, {}, scattering_water());
        const Sonar empty = make_sonar(config, {}, {});
        Scene scene = empty_scene();
        add_floor(scene, 40.0F, -15.0F, add_material(scene, 0.4F), 4);
        scene.water_surface = WaterSurface{.height_m = 3.0, .reflection = 1.0F};
        const std::vector<float> floor = expected_image(empty, scene, EngineKind::rays);
        const std::vector<float> layer = expected_image(layered, scene, EngineKind::rays);
        const std::vector<float> all = expected_image(full, scene, EngineKind::rays);
        const CalibratedModel& model = calibrated_model_of(full);
        const double ka = piston_scale(radians(7.0));
        for (int row = 10; row < 190; ++row) {
            const double range_m = 2.05 + 0.1 * row;
            CAPTURE(range_m);
            const double whole = expected_power(model, 5.78 / (ka * ka), range_m);
            const double of_layer = (layer[row] - floor[row]) / whole;
            const double of_all = (all[row] - floor[row]) / whole;
            if (range_m < 4.5 || (range_m > 8.9 && range_m < 14.0)) CHECK(of_layer < 0.01);
            if (range_m > 5.6 && range_m < 7.5) CHECK(of_layer == test::approx(1.0).epsilon(0.03));
            // The floor is met from 15 m on the axis to 15.2 m at 9 degrees.
            if (range_m < 14.0) CHECK(of_all == test::approx(1.0).epsilon(0.02));
            if (range_m > 16.0) CHECK(of_all < 0.02);
        }
    }

    // A wall 8 m ahead fills the view, whose corners see it at 8 / cos(45) / cos(15) = 11.7 m.
    TEST_CASE("water: a wall ends it in every beam, with every engine") {
        SonarConfig config = calibrated(kind_of(SonarKind::imaging).keys.defaults, 2e5);
        config.azimuth_deg = 90.0;
        config.elevation_deg = 30.0;
        config.azimuth_bins = 48;
        config.range_min_m = 2.0;
        config.range_max_m = 22.0;
        config.range_bins = 200;
        config.instrument = instrument_of(Aperture::line, 2.0);
        const Sonar full = make_sonar(config, {}, scattering_water());
        const Sonar empty = make_sonar(config, {}, {});
        Scene scene = empty_scene();
        const std::uint32_t rock = add_material(scene, 0.4F);
        add_quad(scene, {8.0F, -20.0F, -10.0F}, {8.0F, 20.0F, -10.0F}, {8.0F, 20.0F, 10.0F},
                 {8.0F, -20.0F, 10.0F}, rock);
        for (const EngineKind engine : {EngineKind::slices, EngineKind::rays}) {
            const std::vector<float> wall = expected_image(empty, scene, engine);
            const std::vector<float> both = expected_image(full, scene, engine);
            const auto mean_water = [&](int from, int to) {
                double sum = 0.0;
                for (int row = from; row < to; ++row) {
                    const double range_m = 2.05 + 0.1 * row;
                    for (int at = 48 * row; at < 48 * (row + 1); ++at)
                        sum += (both[at] - wall[at]) * range_m * range_m / (to - from);
                }
                return sum;
            };
            const double before = mean_water(31, 45);
            CHECK(before > 0.0);
            CHECK(mean_water(121, 180) < 0.005 * before);
        }
    }
}
