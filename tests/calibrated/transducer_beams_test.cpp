#include "simulate/calibrated/transducer_beams.h"

#include "core/elementary.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/line_array.h"
#include "simulate/calibrated/model.h"
#include "simulate/calibrated/near_field.h"
#include "simulate/calibrated/piston.h"
#include "simulate/calibrated/range_response.h"
#include "support/calibrated.h"
#include "support/patches.h"
#include "support/test.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr int sounder_bins = 190;

/// An echosounder with bins of 5 cm from 0.5 to 10 m; no noise, no absorption made up for.
CalibratedModel sounder(double width_deg, double resolution_m = 0.05) {
    InstrumentConfig config = bare({});
    config.frequency_hz = 2e5;
    config.beam.aperture = Aperture::piston;
    config.beam.width_deg = width_deg;
    config.pulse.resolution_m = resolution_m;
    const View view{.azimuth_rad = 1.2,
                    .elevation_rad = 1.2,
                    .range_min_m = 0.5,
                    .range_max_m = 10.0,
                    .range_bins = sounder_bins,
                    .beams = 1};
    return calibrated_model(config, {}, view, {});
}

std::vector<float> image_of(const CalibratedModel& model, const std::vector<Sample>& surface) {
    Samples samples;
    samples.items = surface;
    return image_of_samples(model, {.range_bins = sounder_bins, .beams = 1}, samples, {});
}

/// sigma of that rock by the sine of the grazing angle, docs/calibrated.md: Lambert's rule of -27
/// dB and facets whose slopes are those of 10 degrees.
double strength_of_rock(double sine) {
    const double s2 = std::pow(std::tan(radians(10.0)), 2.0);
    const double tan2 = sine * sine / (1.0 - sine * sine + 1e-300);
    return std::pow(10.0, -2.7) * sine * sine +
           0.4 / (8.0 * pi * s2 * std::pow(sine, 4.0)) * std::exp(-1.0 / (2.0 * s2 * tan2));
}

/// The power of the pulse, by range bins off its middle. Its band has the shape of the pattern of
/// a line array, here of one that is 1 mrad wide; the pulse is 1 bin wide between half powers.
double pulse_power(double bins) {
    static const LineArray band = line_array(1e-3, -30.0);
    return std::pow(line_pattern(band, bins * 1e-3), 2.0);
}

/// The echo of a plane bottom `depth_m` below an echosounder with bins of 5 cm, by range.
double bottom_echo(const CalibratedModel& model, double width_deg, double depth_m, double range_m) {
    const double cosine = depth_m / range_m;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double pattern = piston_pattern(piston_scale(radians(width_deg)) * sine);
    return strength_of_rock(cosine) * 2.0 * pi * std::pow(range_m, -3.0) * std::pow(pattern, 4.0) *
           std::pow(10.0, -0.2 * model.absorption_db_per_m * range_m);
}

}  // namespace

TEST_SUITE("calibrated") {
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

    TEST_CASE("echosounder: the echo of a plane bottom, its shape and how it dies away") {
        // At depth h the bottom at range r is a ring of area 2 pi r dr (its radius is the root of
        // r^2 - h^2) that is seen at a grazing angle of sine h / r, as far off the axis as its
        // cosine says. Its echo by range, bottom_echo() dr, is smeared by the power of the pulse.
        constexpr double depth = 5.0;
        constexpr double width_deg = 40.0;
        constexpr double patch = 0.04;
        const CalibratedModel model = sounder(width_deg);
        std::vector<Sample> bottom;
        for (double y = -3.5; y < 3.5; y += patch) {
            for (double z = -3.5; z < 3.5; z += patch) {
                Sample& square = bottom.emplace_back(plate_ahead(depth, patch));
                square.position.y() = static_cast<float>(y + 0.5 * patch);
                square.position.z() = static_cast<float>(z + 0.5 * patch);
            }
        }
        const std::vector<float> image = image_of(model, bottom);
        constexpr double bin_m = 0.05;
        constexpr int steps = 200;  // per bin
        double energy = 0.0;
        double of_equation = 0.0;
        for (int row = 85; row < 106; ++row) {  // 4.75 to 5.8 m
            const double middle = 0.5 + bin_m * (row + 0.5);
            double expected = 0.0;
            for (int k = -3 * steps; k < 3 * steps; ++k) {
                const double off = (k + 0.5) / steps;
                const double range = middle + bin_m * off;
                if (range < depth) continue;
                expected +=
                    bottom_echo(model, width_deg, depth, range) * pulse_power(off) * bin_m / steps;
            }
            energy += image[row];
            of_equation += expected;
            // Two bins behind the front, where the spline that stands for a pulse of one bin is
            // as good as the pulse.
            if (row >= 92) CHECK(std::fabs(image[row] / expected - 1.0) < 0.03);
        }
        CHECK(std::fabs(energy / of_equation - 1.0) < 0.01);
        // No echo above the bottom but for the pulse's side lobes.
        CHECK(image[84] < 1e-3F * image[90]);
        CHECK(image[90] > 3.0F * image[100]);
    }

    // 0.1 degrees at 900 kHz, 0.83 m long: the far field begins beyond 400 m. Sums fill the table
    // of a narrow view, transforms that of a wide one.
    TEST_CASE("near field: the table of a long array is the pattern") {
        struct Case {
            double side_lobe_db, frequency_hz, most_sine;
        };
        for (const Case& c :
             {Case{-13.3, 9e5, 0.035}, Case{-20.0, 1e6, sincos(radians(80.0)).sin}}) {
            const LineArray array = line_array(radians(0.1), c.side_lobe_db);
            const double wavelength = 1480.0 / c.frequency_hz;
            const UnfocusedBeam beam = unfocused_beam(array, wavelength, 0.5, c.most_sine);
            for (const double range : {1.0, 3.0, 10.0, 200.0}) {
                double peak = 0.0;
                double worst = 0.0;
                for (double u = -0.98; u < 0.98; u += 0.0337) {
                    for (const double at : {u * c.most_sine, 0.03 * u}) {
                        const std::complex<double> one_way =
                            unfocused_pattern(array, at, wavelength, 1.0 / range);
                        const std::complex<double> entry =
                            beam.at(static_cast<float>(at), static_cast<float>(range));
                        peak = std::max(peak, std::norm(one_way));
                        worst = std::max(worst, std::abs(entry - one_way * one_way));
                    }
                }
                CAPTURE(c.most_sine);
                CAPTURE(range);
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
