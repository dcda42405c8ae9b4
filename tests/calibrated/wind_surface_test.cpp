#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/trace/visible_water_surface.h"

namespace {

double surface_db(double grazing_deg, double wind_m_s, double hz) {
    return db_of_power(wind_surface_section(radians(grazing_deg), wind_m_s, hz));
}

}  // namespace

// Numbers of the report's equations as an open implementation writes them
// (BochicTrdar/Fundamentos-de-Acustica-Submarina, apl_surface_sigma.m and apl_bub_sigma.m),
// evaluated apart from this program.
TEST_CASE("wind: strengths of the surface at high frequency") {
    constexpr std::array angles{5.0, 20.0, 45.0, 70.0, 90.0};
    struct Row {
        double hz, wind;
        std::array<double, 5> db;
    };
    for (const Row& row : {Row{25e3, 3.0, {-49.09, -48.85, -42.91, -26.59, 7.68}},
                           Row{25e3, 10.0, {-31.80, -22.54, -19.39, -16.72, 4.40}},
                           Row{100e3, 5.0, {-36.96, -36.65, -35.60, -24.44, 6.01}},
                           Row{100e3, 15.0, {-34.00, -28.06, -24.84, -20.05, 0.07}},
                           Row{400e3, 10.0, {-36.00, -30.07, -26.85, -23.72, -2.50}}}) {
        for (std::size_t k = 0; k < angles.size(); ++k) {
            CAPTURE_ALL(row.hz, row.wind, angles[k]);
            CHECK(std::fabs(surface_db(angles[k], row.wind, row.hz) - row.db[k]) < 0.05);
        }
    }
}

// At 30 degrees the fit of Chapman and Harris is 2.6 - 42.4 log b. With 20 knots and 1 kHz b is
// 158 x 200^-0.58 = 7.31, so -34.0 dB; at 10 degrees 3.3 b log(1 / 3) less, -45.5 dB.
TEST_CASE("wind: strengths of the surface at low frequency") {
    const double wind = 20.0 * 1852.0 / 3600.0;
    CHECK(surface_db(30.0, wind, 1e3) == approx(-34.04).epsilon(2e-3));
    CHECK(surface_db(10.0, wind, 1e3) == approx(-45.55).epsilon(2e-3));
    // More wind sends more back, and the strengths are finite in a calm and at the horizon.
    CHECK(surface_db(20.0, 12.0, 3e3) > surface_db(20.0, 6.0, 3e3) + 3.0);
    for (const double hz : {1e3, 1e5}) {
        for (const double wind_m_s : {0.0, 0.5, 40.0})
            CHECK(std::isfinite(wind_surface_section(0.0, wind_m_s, hz)));
    }
}

// The integral over rings of sigma(grazing) b(theta)^4 2 pi r dr / r^4, b the one-way pattern.
TEST_CASE("wind: the flash of the surface in an echosounder that looks up") {
    // A disc straight below the surface of the water, 10 m away.
    SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), 1e5);
    config.opening_deg = 60.0;
    set_range(config, 5.0, 15.0, 400);
    config.mount.rpy_deg = {0.0, 180.0, 0.0};
    config.instrument = instrument_of(Aperture::piston, 10.0, 0.05);
    config.instrument.frequency_hz = 1e5;
    Sonar sonar = make_sonar(config, {});
    sonar.settings.sources = {std::make_shared<const ScatteringSurface>()};
    const double scale = piston_scale(radians(10.0));
    const auto absorption = calibrated_model_of(sonar).absorption_db_per_m;
    const auto flash = [&](double wind_m_s) {
        return integral(0.0, radians(30.0), 20000, [&](double theta) {
            const double r = 10.0 / std::cos(theta);
            const double pattern = piston_pattern(scale * std::sin(theta));
            const double dr = 10.0 * std::sin(theta) / std::pow(std::cos(theta), 2);
            return wind_surface_section(0.5 * pi - theta, wind_m_s, 1e5) * std::pow(pattern, 4) *
                   2.0 * pi * dr / std::pow(r, 3) * power_of_db(-2.0 * absorption * r);
        });
    };
    const auto image_in = [&](double wind_m_s) {
        Scene scene = floor_scene(40.0F, -15.0F, 0.4F, 4);
        scene.water_surface = {.height_m = 10.0, .reflection = 1.0F, .wind_m_s = wind_m_s};
        return expected_image(sonar, scene, EngineKind::rays);
    };
    const std::vector<float> windy = image_in(10.0);
    const std::vector<float> breeze = image_in(3.0);
    CHECK(db_of_power(total(windy) / total(breeze)) ==
          approx(db_of_power(flash(10.0) / flash(3.0))).epsilon(0.01));
    // The level: the taps of the pulse sum to its integral over range.
    const CalibratedModel& model = calibrated_model_of(sonar);
    const double taps = total(model.power_taps.taps);
    CHECK(std::fabs(db_of_power(total(windy) / (taps * flash(10.0)))) < 0.1);
    // The first echo is at 10 m.
    const auto brightest = std::ranges::max_element(windy) - windy.begin();
    CHECK(5.0 + 0.025 * (static_cast<double>(brightest) + 0.5) == approx(10.0).epsilon(0.01));
}
