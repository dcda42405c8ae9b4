#include "core/decibel.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/range_response.h"
#include "support/test.h"

TEST_CASE("piston: axis, half power, first null, first side lobe") {
    CHECK(std::fabs(piston_pattern(0.0) - 1.0) < 1e-12);
    const double width = radians(7.0);
    const double half = piston_pattern(piston_scale(width) * std::sin(0.5 * width));
    CHECK(std::fabs(half * half - 0.5) < 1e-8);
    // J1 is 0 at 3.8317059702; 2 J1(x) / x is least at 5.1356223018, where it is -0.132280.
    CHECK(std::fabs(piston_pattern(3.8317059702)) < 1e-9);
    CHECK(std::fabs(piston_pattern(5.1356223018) + 0.132280) < 1e-6);
    // A long way off: J1(40) = 0.126038318.
    CHECK(std::fabs(piston_pattern(40.0) - 2.0 * 0.126038318 / 40.0) < 1e-8);
}

TEST_CASE("near field: on the axis of an array without taper, Fresnel's integral") {
    // At r the amplitude on the axis is (C(w) - i S(w)) / w, w = L / sqrt(2 lambda r).
    LineArray array;
    array.wavelengths = 100.0;
    const double wavelength = 1e-3;
    // r = L^2 / (2 lambda) = 5 m: w = 1, C(1) = 0.7798934, S(1) = 0.4382591.
    const double near = std::abs(unfocused_pattern(array, 0.0, wavelength, 1.0 / 5.0));
    CHECK(std::fabs(near / std::hypot(0.7798934, 0.4382591) - 1.0) < 2e-3);
    // Far away nothing of it is left.
    CHECK(std::fabs(std::abs(unfocused_pattern(array, 0.0, wavelength, 0.0)) - 1.0) < 1e-9);
}

// 0.1 degrees at 900 kHz, 0.83 m long: the far field begins beyond 400 m. Narrow and wide views.
TEST_CASE("near field: the table of a long array is the pattern") {
    struct Case {
        double side_lobe_db, frequency_hz, max_sine;
    };
    for (const Case& c : {Case{-13.3, 9e5, 0.035}, Case{-20.0, 1e6, sincos(radians(80.0)).sin}}) {
        const LineArray array = line_array(radians(0.1), c.side_lobe_db);
        const double wavelength = 1480.0 / c.frequency_hz;
        const UnfocusedBeam beam = unfocused_beam(array, wavelength, 0.5, c.max_sine);
        for (const double range : {1.0, 3.0, 10.0, 200.0}) {
            double peak = 0.0;
            double worst = 0.0;
            for (double u = -0.98; u < 0.98; u += 0.0337) {
                for (const double at : {u * c.max_sine, 0.03 * u}) {
                    const std::complex<double> one_way =
                        unfocused_pattern(array, at, wavelength, 1.0 / range);
                    const std::complex<double> entry =
                        beam.at(static_cast<float>(at), static_cast<float>(range));
                    peak = std::max(peak, std::norm(one_way));
                    worst = std::max(worst, std::abs(entry - one_way * one_way));
                }
            }
            CAPTURE_ALL(c.max_sine, range);
            CHECK(worst < 0.05 * peak);
        }
    }
}

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

TEST_CASE("pulse: the half-power widths of its spline, as the documents have them") {
    struct Width {
        double pulse, spline;  // bins
    };
    for (const Width& w : {Width{0.1, 0.47}, Width{0.5, 0.52}, Width{1.0, 0.67}, Width{1.5, 1.13},
                           Width{2.0, 1.87}, Width{3.0, 2.87}, Width{5.0, 4.92}}) {
        CAPTURE(w.pulse);
        const RangeTaps taps = range_taps(w.pulse, -30.0);
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
        CHECK(std::fabs(2.0 * half - w.spline) < 0.01);
        if (w.pulse >= 2.0) CHECK(std::fabs(std::sqrt(power_at(0.0)) - 1.0) < 0.1);
    }
}
