#include "simulate/calibrated/line_array.h"

#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/range_response.h"
#include "support/test.h"

using namespace sonarsim;

TEST_SUITE("calibrated") {
    TEST_CASE("line array: width and side lobe are those asked for") {
        for (const double width_deg : {0.4, 1.0, 3.0}) {
            for (const double side_lobe_db : {-13.3, -20.0, -30.0, -40.0}) {
                const LineArray array = line_array(radians(width_deg), side_lobe_db);
                const double half = line_pattern(array, std::sin(radians(0.5 * width_deg)));
                CHECK(std::fabs(half * half - 0.5) < 1e-6);
                double highest = 0.0;
                bool past_null = false;
                for (double t = 0.0; t < 8.0; t += 0.001) {
                    const double level = line_pattern(array, t / array.wavelengths);
                    past_null = past_null || level <= 0.0;
                    if (past_null) highest = std::max(highest, level * level);
                }
                CHECK(std::fabs(db_of_power(highest) - side_lobe_db) < 0.1);
            }
        }
    }

    TEST_CASE("line array: the pattern is the transform of the weight") {
        const LineArray array = line_array(radians(1.0), -25.0);
        for (const double u : {0.0, 0.003, 0.011, 0.05}) {
            std::complex<double> sum = 0.0;
            constexpr int n = 20000;
            for (int k = 0; k < n; ++k) {
                const double x = (k + 0.5) / n - 0.5;
                sum += array.weight(x) * std::polar(1.0 / n, 2.0 * pi * x * array.wavelengths * u);
            }
            CHECK(std::fabs(sum.real() - line_pattern(array, u)) < 1e-6);
            CHECK(std::fabs(sum.imag()) < 1e-9);
        }
    }

    TEST_CASE("pulse: the half-power widths of its spline, as the documents have them") {
        struct Width {
            double of_pulse, of_spline;  // bins
        };
        for (const Width& w :
             {Width{0.1, 0.47}, Width{0.5, 0.52}, Width{1.0, 0.67}, Width{1.5, 1.13},
              Width{2.0, 1.87}, Width{3.0, 2.87}, Width{5.0, 4.92}}) {
            CAPTURE(w.of_pulse);
            const RangeTaps taps = range_taps(w.of_pulse, -30.0, false);
            const auto power_at = [&](double x) {
                const auto k = static_cast<std::size_t>(x);
                const float* const tap = taps.taps.data() + taps.reach + k;
                const double amplitude =
                    std::lerp(static_cast<double>(tap[0]), tap[1], x - std::floor(x));
                return amplitude * amplitude;
            };
            double half = 0.0;
            while (power_at(half) > 0.5 * power_at(0.0))
                half += 1e-3;
            CHECK(std::fabs(2.0 * half - w.of_spline) < 0.01);
            if (w.of_pulse >= 2.0) CHECK(std::fabs(std::sqrt(power_at(0.0)) - 1.0) < 0.1);
        }
    }
}
