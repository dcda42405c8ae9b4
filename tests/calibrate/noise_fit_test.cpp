#include "calibrate/noise_fit.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE("calibrate") {
    // Blocks of 0.1 dB from 2 to 40 m on -77 dB + 30 log r + 0.08 r, r at least the start. In 20
    // draws an interval of 95 % misses more than 5 times with a probability of 3e-4.
    TEST_CASE("noise fit: a start of the gain between two steps of the search") {
        std::mt19937 generator(1);
        std::normal_distribution<double> error_db(0.0, 0.1);
        for (const double from_m : {6.0, 9.0, 10.3, 15.0}) {
            CAPTURE(from_m);
            int levels = 0;
            int factors = 0;
            for (int draw = 0; draw < 20; ++draw) {
                std::vector<NoiseBlock> blocks;
                for (int k = 0; k < 48; ++k) {
                    const double range_m = 2.0 + 38.0 * (k + 0.5) / 48.0;
                    const double r = std::max(range_m, from_m);
                    blocks.push_back(
                        {.row = 8 * k,
                         .range_m = range_m,
                         .level_db = -77.0 + 30.0 * std::log10(r) + 0.08 * r + error_db(generator),
                         .homogeneous = true});
                }
                const auto fit = fit_noise(blocks, 0.04);
                REQUIRE(fit);
                CHECK(fit->tvg_from_m.value == test::approx(from_m).epsilon(0.05));
                levels += fit->level_db.low <= -77.0 && -77.0 <= fit->level_db.high ? 1 : 0;
                factors += fit->tvg_log.low <= 30.0 && 30.0 <= fit->tvg_log.high ? 1 : 0;
            }
            CHECK(levels >= 15);
            CHECK(factors >= 15);
        }
    }
}
