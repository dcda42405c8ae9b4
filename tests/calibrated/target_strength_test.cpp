#include "calibrated/target_strength.h"

#include <doctest/doctest.h>

#include <cmath>

#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE("calibrated") {
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
