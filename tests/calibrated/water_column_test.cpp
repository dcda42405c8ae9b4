#include "simulate/calibrated/water_column.h"

#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/piston.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The greatest difference of an image's beams `from` to `to` from the closed form, dB. The pulse
/// reaches over the ends of the range in the first and the last bins.
template <class Psi>
double greatest_error_db(const CalibratedModel& model, const View& view, Psi psi_of_beam) {
    const std::vector<float> image = water_image(model, view);
    double worst = 0.0;
    for (int row = 10; row < view.range_bins - 10; ++row) {
        const double range_m = view.range_min_m + (row + 0.5) * view.bin_m();
        for (int beam = 0; beam < view.beams; ++beam) {
            const double psi = psi_of_beam(beam, range_m);
            if (psi == 0.0) continue;
            const double error =
                db_of_power(image[static_cast<std::size_t>(row) * view.beams + beam] /
                            expected_power(model, psi, range_m));
            worst = std::max(worst, std::fabs(error));
        }
    }
    return worst;
}

double sinc4(double t) {
    const double x = pi * t;
    return x == 0.0 ? 1.0 : std::pow(std::sin(x) / x, 4.0);
}

}  // namespace

TEST_SUITE("calibrated") {
    // The equivalent beam angle of a disc is 5.78 / (ka)^2 (e.g. Simmonds and MacLennan, Fisheries
    // Acoustics, 2005). The far side lobes outside the view, and that constant, leave 0.03 dB.
    TEST_CASE("water: the level in an echosounder, at every range") {
        const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
        const CalibratedModel model = sounder(SpeckleMode::none);
        const double ka = piston_scale(radians(7.0));
        CHECK(greatest_error_db(model, view, [&](int, double) { return 5.78 / (ka * ka); }) < 0.05);
    }

    // A fan whose pattern is constant over E of elevation. The beam at the sine u is a cone; about
    // its axis it sees 2 asin(sin(E / 2) / sqrt(1 - u^2)), and its width in u is the integral of
    // the array's pattern, taper_loss / (L / lambda). The outer beams have lobes beyond the view.
    TEST_CASE("water: the level in the beams of a fan, at every range") {
        InstrumentConfig config = instrument_of(Aperture::line, 2.0);
        config.beam.side_lobe_db = -25.0;
        const View view = view_of(ViewShape::fan, 90.0, 20.0, 64);
        const BeamSines sines = fan_sines(90.0, 64);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, sines);
        const LineArray array = line_array(radians(2.0), -25.0);
        const double width = taper_loss(array) / array.wavelengths;
        const auto psi = [&](int beam, double) {
            if (beam < 6 || beam >= 58) return 0.0;
            const double u = sines.middles[beam];
            return 2.0 * std::asin(std::sin(radians(10.0)) / std::sqrt(1.0 - u * u)) * width;
        };
        CHECK(greatest_error_db(model, view, psi) < 0.1);
    }

    // Beyond L^2 / lambda = 0.03 m^2 / 0.0074 m the patterns are those of the far field: across the
    // integral of sinc^4 over the angle, along 2 / 3 of lambda / L, since sinc^4 has that integral.
    TEST_CASE("water: the level in a side-scan sonar's far field") {
        InstrumentConfig config = instrument_of(Aperture::port_starboard, 2.5);
        const View view = view_of(ViewShape::port_starboard, 170.0, 60.0, 2);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, {});
        const LineArray along = line_array(radians(2.5), config.beam.side_lobe_db);
        const double across = line_array(radians(50.0), 0.0).wavelengths;
        double psi = 0.0;
        constexpr int steps = 1000;
        for (int k = 0; k < steps; ++k) {
            // Off the axis of the side, from straight down on, within the view.
            const double azimuth = radians(85.0) * (k + 0.5) / steps;
            const double other = azimuth - radians(70.0);
            const double step = radians(85.0) / steps;
            psi += sinc4(across * std::sin(other)) * step;
            if (std::cos(azimuth + radians(70.0)) > 0.0)
                psi += sinc4(across * std::sin(azimuth + radians(70.0))) * step;
        }
        psi *= 2.0 / 3.0 / along.wavelengths;
        const auto far = [&](int, double range_m) { return range_m > 15.0 ? psi : 0.0; };
        CHECK(greatest_error_db(model, view, far) < 0.15);
    }

    // As the fan's, but the head sends through the array, too: the integral of sinc^4.
    TEST_CASE("water: the level in a scanning sonar") {
        InstrumentConfig config = instrument_of(Aperture::head, 2.0);
        const View view = view_of(ViewShape::fan, 40.0, 20.0, 1);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, {});
        const LineArray array = line_array(radians(2.0), config.beam.side_lobe_db);
        const double psi = radians(20.0) * 2.0 / 3.0 / array.wavelengths;
        CHECK(greatest_error_db(model, view, [&](int, double) { return psi; }) < 0.05);
    }

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
        set_range(config, 2.0, 22.0, 200);
        config.instrument = instrument_of(Aperture::piston, 7.0);
        WaterConfig water;
        water.layers.push_back({.depth_m = {8.0, 11.0}, .scattering_db_per_m3 = strength_db});
        const Sonar layered = make_sonar(config, {}, water);
        const Sonar full = make_sonar(config, {}, scattering_water());
        const Sonar empty = make_sonar(config, {}, {});
        Scene scene = floor_scene(40.0F, -15.0F, 0.4F, 4);
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
        set_range(config, 2.0, 22.0, 200);
        config.instrument = instrument_of(Aperture::line, 2.0);
        const Sonar full = make_sonar(config, {}, scattering_water());
        const Sonar empty = make_sonar(config, {}, {});
        Scene scene = empty_scene();
        const std::uint32_t rock = add_material(scene, 0.4F);
        add_quad(scene, {8.0F, -20.0F, -10.0F}, {8.0F, 20.0F, -10.0F}, {8.0F, 20.0F, 10.0F},
                 {8.0F, -20.0F, 10.0F}, rock);
        for (const EngineKind engine : {EngineKind::strips, EngineKind::rays}) {
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
