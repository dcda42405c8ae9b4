#include "calibrated/volume_strengths.h"

#include <doctest/doctest.h>

#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE("calibrated") {
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
                CAPTURE(k);
                CAPTURE(um);
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
}
