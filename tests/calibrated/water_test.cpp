#include "calibrated/water.h"

#include <doctest/doctest.h>

#include <cmath>

#include "mission/mission.h"

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
}
