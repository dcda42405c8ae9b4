#include "simulate/calibrated/water_column.h"

#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/equation/water.h"
#include "support/statistics.h"

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

/// Absorption in dB/m by M. A. Ainslie and J. G. McColm, J. Acoust. Soc. Am. 103 (1998), 1671: a
/// simpler fit, which its authors hold to be within 10 % of Francois and Garrison's.
double by_ainslie_mccolm(double frequency_hz, const WaterState& w) {
    const double f2 = frequency_hz * frequency_hz * 1e-6;
    const double km = 1e-3 * w.depth_m;
    const double boric = 0.78 * std::sqrt(w.salinity_psu / 35.0) * std::exp(w.temperature_c / 26.0);
    const double sulphate = 42.0 * std::exp(w.temperature_c / 17.0);
    return 1e-3 * (0.106 * boric * f2 / (f2 + boric * boric) * std::exp((w.ph - 8.0) / 0.56) +
                   0.52 * (1.0 + w.temperature_c / 43.0) * (w.salinity_psu / 35.0) * sulphate * f2 /
                       (f2 + sulphate * sulphate) * std::exp(-km / 6.0) +
                   0.00049 * f2 * std::exp(-(w.temperature_c / 27.0 + km / 17.0)));
}

}  // namespace

// The equivalent beam angle of a disc is 5.78 / (ka)^2 (e.g. Simmonds and MacLennan, Fisheries
// Acoustics, 2005). The far side lobes outside the view, and that constant, leave 0.03 dB.
TEST_CASE("water: the level in an echosounder, at every range") {
    const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
    const CalibratedModel model = sounder(SpeckleMode::none);
    const double ka = piston_scale(radians(7.0));
    CHECK(greatest_error_db(model, view, [&](int, double) { return 5.78 / (ka * ka); }) < 0.05);
    // A beam that is narrow for the cone.
    const View wide = view_of(ViewShape::cone, 80.0, 80.0, 1);
    const InstrumentConfig narrow = instrument_of(Aperture::piston, 1.0);
    const CalibratedModel fine = calibrated_model(narrow, scattering_water(), wide, {});
    const double narrow_ka = piston_scale(radians(1.0));
    CHECK(greatest_error_db(fine, wide,
                            [&](int, double) { return 5.78 / (narrow_ka * narrow_ka); }) < 0.1);
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
    // Off the axis of either side, from straight down on, within the view.
    const double psi =
        2.0 / 3.0 / along.wavelengths * integral(0.0, radians(85.0), 1000, [&](double azimuth) {
            const double other = azimuth + radians(70.0);
            return sinc4(across * std::sin(azimuth - radians(70.0))) +
                   (std::cos(other) > 0.0 ? sinc4(across * std::sin(other)) : 0.0);
        });
    const auto far = [&](int, double range_m) { return range_m > 15.0 ? psi : 0.0; };
    CHECK(greatest_error_db(model, view, far) < 0.15);
}

// As the fan's, but the head sends through the array, too: the integral of sinc^4.
TEST_CASE("water: the level in a scanning sonar") {
    const View view = view_of(ViewShape::fan, 40.0, 20.0, 1);
    for (const double width_deg : {2.0, 0.3}) {
        const InstrumentConfig config = instrument_of(Aperture::head, width_deg);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, {});
        const LineArray array = line_array(radians(width_deg), config.beam.side_lobe_db);
        const double psi = radians(20.0) * 2.0 / 3.0 / array.wavelengths;
        CHECK(greatest_error_db(model, view, [&](int, double) { return psi; }) < 0.05);
    }
}

// Bins 4 apart, two resolutions, hardly overlap. 45 of them in each of 60 pings: the mean of
// 2,700 exponential draws is within 7 % (3.6 sigma).
TEST_CASE("water: its speckle is exponential in power, new in every ping, keyed by the seed") {
    const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
    const CalibratedModel model = sounder(SpeckleMode::scene);
    const std::vector<float> expected = water_image(sounder(SpeckleMode::none), view);
    std::vector<double> powers;
    for (std::uint32_t ping = 0; ping < 60; ++ping) {
        const std::vector<float> image = water_image(model, view, {7, 2, ping});
        for (int row = 10; row < 190; row += 4)
            powers.push_back(image[row] / expected[row]);
    }
    CHECK(mean(powers) == approx(1.0).epsilon(0.07));
    CHECK(ks_p_value(powers, [](double x) { return 1.0 - std::exp(-x); }) > 1e-3);
    CHECK(water_image(model, view, {7, 2, 0}) == water_image(model, view, {7, 2, 0}));
    CHECK(water_image(model, view, {7, 2, 0}) != water_image(model, view, {8, 2, 0}));
    CHECK(water_image(model, view, {7, 2, 0}) != water_image(model, view, {7, 2, 1}));
}

// The sonar is 3 m below the surface and looks straight down: the layer from 8 to 11 m of depth
// lies between 5 and 8 m of range, but for the edge of a 7 degree beam, 0.02 m.
TEST_CASE("water: a layer is at its depth, and the water ends at the bottom") {
    SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), 2e5);
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
        const double layer_share = (layer[row] - floor[row]) / whole;
        const double all_share = (all[row] - floor[row]) / whole;
        if (range_m < 4.5 || (range_m > 8.9 && range_m < 14.0)) CHECK(layer_share < 0.01);
        if (range_m > 5.6 && range_m < 7.5) CHECK(layer_share == approx(1.0).epsilon(0.03));
        // The floor is met from 15 m on the axis to 15.2 m at 9 degrees.
        if (range_m < 14.0) CHECK(all_share == approx(1.0).epsilon(0.02));
        if (range_m > 16.0) CHECK(all_share < 0.02);
    }
}

// A wall 8 m ahead fills the view, whose corners see it at 8 / cos(45) / cos(15) = 11.7 m.
TEST_CASE("water: a wall ends it in every beam, with every engine") {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 2e5);
    set_fan(config, 90.0, 30.0, 48);
    set_range(config, 2.0, 22.0, 200);
    config.instrument = instrument_of(Aperture::line, 2.0);
    const Sonar full = make_sonar(config, {}, scattering_water());
    const Sonar empty = make_sonar(config, {}, {});
    const Scene scene = rectangle_scene({8, -20, -10}, {8, 20, 10}, 0.4F);
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

TEST_CASE("absorption agrees with another published formula") {
    for (const double khz : {5.0, 38.0, 100.0, 200.0, 455.0, 900.0}) {
        for (const double t : {0.0, 8.0, 15.0, 25.0}) {
            const WaterState water{.temperature_c = t, .depth_m = 50.0};
            const double ours = absorption_db_per_m(1e3 * khz, water);
            CHECK(std::fabs(ours / by_ainslie_mccolm(1e3 * khz, water) - 1.0) < 0.11);
        }
    }
}

// Far below k a = 1 the form function is 1.25 (k a)^2: s_v = 3 M 1.25^2 k^4 a^3 / (16 pi rho).
// Far above, a grain scatters as a sphere of the form 1 / 0.9.
TEST_CASE("water: fine particles scatter by Rayleigh's law, coarse ones by their area") {
    const auto by_hand = [](double mg_l, double um, double k) {
        const double a = 0.5e-6 * um;
        return 3.0 * 1e-3 * mg_l * 1.25 * 1.25 * k * k * k * k * a * a * a / (16.0 * pi * 2650.0);
    };
    for (const double k : {50.0, 400.0, 1600.0}) {
        for (const double um : {4.0, 20.0, 50.0}) {
            CAPTURE_ALL(k, um);
            CHECK(suspended_strength(10.0, um, k) == approx(by_hand(10.0, um, k)).epsilon(0.06));
        }
    }
    // 10 mg/l of 50 um at 400 kHz.
    CHECK(db_of_power(suspended_strength(10.0, 50.0, 2.0 * pi * 4e5 / 1480.0)) ==
          approx(-73.35).epsilon(0.0005));
    constexpr double a = 1e-3;
    const double expected = 3.0 * 1e-2 / (16.0 * pi * 2650.0 * a * 0.81);
    CHECK(suspended_strength(10.0, 2e6 * a, 4e4) == approx(expected).epsilon(0.01));
}

TEST_CASE("water: what it holds, and what an instrument takes for granted") {
    WaterConfig water;
    InstrumentConfig instrument;
    CHECK(volume_strength(water_of(water, instrument), 4e5) == 0.0);
    instrument.usual_water = WaterContent::coastal;
    const double usual = volume_strength(water_of(water, instrument), 4e5);
    const double particles = suspended_strength(20.0, 50.0, 2.0 * pi * 4e5 / 1480.0);
    CHECK(usual == approx(power_of_db(-75.0) + particles).epsilon(1e-12));
    // The mission decides if it says something.
    water.content = WaterContent::none;
    CHECK(volume_strength(water_of(water, instrument), 4e5) == 0.0);
    water.content = WaterContent::plume;
    CHECK(volume_strength(water_of(water, instrument), 4e5) == power_of_db(-55.0));
    water.scattering_db_per_m3 = -70.0;
    CHECK(volume_strength(water, 4e5) == power_of_db(-70.0));
}

// 30 cm: log L = 1.4771, at 38 kHz log f = 1.5798. 19.1 x 1.4771 - 0.9 x 1.5798 - 62.0 = -35.2.
TEST_CASE("target strength: fish by their length") {
    const auto db = [](double length_m, double hz) {
        return db_of_power(fish_section_m2(length_m, hz));
    };
    CHECK(db(0.3, 38e3) == approx(-35.21).epsilon(1e-3));
    CHECK(db(0.1, 400e3) == approx(-45.24).epsilon(1e-3));
}

// Minnaert: a bubble of 1 mm just below the surface rings at 3.26 kHz. There the section is
// 1 / k^2; far above it is a^2, far below a^2 (f / f0)^4, and a large one has a^2 / 4.
TEST_CASE("target strength: bubbles at, above and below resonance") {
    const auto section = [](double radius_m, double hz, double depth_m = 0.0) {
        return bubble_section_m2(radius_m, depth_m, 1000.0, 1500.0, hz);
    };
    const double f0 = std::sqrt(3.0 * 1.4 * 101325.0 / 1000.0) / (2.0 * pi * 1e-3);
    CHECK(f0 == approx(3283.0).epsilon(1e-3));
    const double k = 2.0 * pi * f0 / 1500.0;
    CHECK(section(1e-3, f0) == approx(1.0 / (k * k)).epsilon(1e-9));
    CHECK(section(1e-3, 20e3) == approx(1e-6).epsilon(0.07));
    CHECK(section(1e-3, 300.0) == approx(1e-6 * std::pow(300.0 / f0, 4)).epsilon(0.02));
    CHECK(section(1e-2, 1e6) == approx(0.25e-4).epsilon(1e-9));
    // At 30 m there are four atmospheres, and it rings an octave higher.
    CHECK(section(1e-3, f0, 30.987) < 0.2 * section(1e-3, f0));
    CHECK(section(1e-3, 2.0 * f0, 30.987) == approx(0.25 / (k * k)).epsilon(0.02));
}
