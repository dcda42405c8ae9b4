#include "simulate/calibrated/water.h"

#include "input/mission/mission.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/target_strength.h"
#include "simulate/calibrated/water_column.h"
#include "support/test.h"

using namespace sonarsim;

namespace {

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

TEST_SUITE("calibrated") {
    TEST_CASE("absorption agrees with another published formula") {
        for (const double khz : {5.0, 38.0, 100.0, 200.0, 455.0, 900.0}) {
            for (const double t : {0.0, 8.0, 15.0, 25.0}) {
                const WaterState water{.temperature_c = t, .depth_m = 50.0};
                const double ours = absorption_db_per_m(1e3 * khz, water);
                CHECK(std::fabs(ours / by_ainslie_mccolm(1e3 * khz, water) - 1.0) < 0.11);
            }
        }
    }

    TEST_CASE("sound speed: Mackenzie's own check") {
        // 25 degrees, 35 psu, 1000 m: 1550.744 m/s.
        CHECK(std::fabs(sound_speed_m_s({.temperature_c = 25.0, .depth_m = 1000.0}) - 1550.744) <
              1e-3);
    }

    // Far below k a = 1 the form function is 1.25 (k a)^2: s_v = 3 M 1.25^2 k^4 a^3 / (16 pi rho).
    // Far above, a grain scatters as a sphere of the form 1 / 0.9.
    TEST_CASE("water: fine particles scatter by Rayleigh's law, coarse ones by their area") {
        const auto by_hand = [](double mg_l, double um, double k) {
            const double a = 0.5e-6 * um;
            return 3.0 * 1e-3 * mg_l * 1.25 * 1.25 * k * k * k * k * a * a * a /
                   (16.0 * pi * 2650.0);
        };
        for (const double k : {50.0, 400.0, 1600.0}) {
            for (const double um : {4.0, 20.0, 50.0}) {
                CAPTURE_ALL(k, um);
                CHECK(suspended_strength(10.0, um, k) ==
                      test::approx(by_hand(10.0, um, k)).epsilon(0.06));
            }
        }
        // 10 mg/l of 50 um at 400 kHz.
        CHECK(db_of_power(suspended_strength(10.0, 50.0, 2.0 * pi * 4e5 / 1480.0)) ==
              test::approx(-73.35).epsilon(0.0005));
        constexpr double a = 1e-3;
        const double expected = 3.0 * 1e-2 / (16.0 * pi * 2650.0 * a * 0.81);
        CHECK(suspended_strength(10.0, 2e6 * a, 4e4) == test::approx(expected).epsilon(0.01));
    }

    TEST_CASE("water: what it holds, and what an instrument takes for granted") {
        WaterConfig water;
        InstrumentConfig instrument;
        CHECK(volume_strength(water_of(water, instrument), 4e5) == 0.0);
        instrument.usual_water = WaterContent::coastal;
        const double usual = volume_strength(water_of(water, instrument), 4e5);
        const double particles = suspended_strength(20.0, 50.0, 2.0 * pi * 4e5 / 1480.0);
        CHECK(usual == test::approx(power_of_db(-75.0) + particles).epsilon(1e-12));
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
        CHECK(db(0.3, 38e3) == test::approx(-35.21).epsilon(1e-3));
        CHECK(db(0.1, 400e3) == test::approx(-45.24).epsilon(1e-3));
    }

    // Minnaert: a bubble of 1 mm just below the surface rings at 3.26 kHz. There the section is
    // 1 / k^2; far above it is a^2, far below a^2 (f / f0)^4, and a large one has a^2 / 4.
    TEST_CASE("target strength: bubbles at, above and below resonance") {
        const auto section = [](double radius_m, double hz, double depth_m = 0.0) {
            return bubble_section_m2(radius_m, depth_m, 1000.0, 1500.0, hz);
        };
        const double f0 = std::sqrt(3.0 * 1.4 * 101325.0 / 1000.0) / (2.0 * pi * 1e-3);
        CHECK(f0 == test::approx(3283.0).epsilon(1e-3));
        const double k = 2.0 * pi * f0 / 1500.0;
        CHECK(section(1e-3, f0) == test::approx(1.0 / (k * k)).epsilon(1e-9));
        CHECK(section(1e-3, 20e3) == test::approx(1e-6).epsilon(0.07));
        CHECK(section(1e-3, 300.0) == test::approx(1e-6 * std::pow(300.0 / f0, 4)).epsilon(0.02));
        CHECK(section(1e-2, 1e6) == test::approx(0.25e-4).epsilon(1e-9));
        // At 30 m there are four atmospheres, and it rings an octave higher.
        CHECK(section(1e-3, f0, 30.987) < 0.2 * section(1e-3, f0));
        CHECK(section(1e-3, 2.0 * f0, 30.987) == test::approx(0.25 / (k * k)).epsilon(0.02));
    }
}
