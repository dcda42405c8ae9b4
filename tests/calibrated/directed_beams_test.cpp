#include "calibrated/directed_beams.h"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "calibrated/model.h"
#include "calibrated/near_field.h"
#include "calibrated/piston.h"
#include "core/units.h"

using namespace sonarsim;

namespace {

constexpr int sounder_bins = 190;

/// An echosounder with bins of 5 cm from 0.5 to 10 m; no noise, no absorption made up for.
CalibratedModel sounder(double width_deg) {
    InstrumentConfig config;
    config.frequency_hz = 2e5;
    config.beam.aperture = Aperture::piston;
    config.beam.width_deg = width_deg;
    config.receiver.tvg_log = 0.0;
    config.receiver.tvg_absorption = false;
    config.receiver.noise_db = -300.0;
    config.speckle.mode = SpeckleMode::none;
    const View view{.azimuth_rad = 1.2,
                    .elevation_rad = 1.2,
                    .range_min_m = 0.5,
                    .range_max_m = 10.0,
                    .range_bins = sounder_bins,
                    .beams = 1};
    return calibrated_model(config, {}, view, {});
}

double energy_of(const CalibratedModel& model, const std::vector<Sample>& surface) {
    Samples samples;
    samples.items = surface;
    Scene scene;
    scene.materials.push_back({.name = "rock", .reflection = 0.4F});
    std::vector<float> image(sounder_bins);
    form_calibrated(model, samples, scene, {}, {}, {}, image);
    double sum = 0.0;
    for (const float value : image)
        sum += value;
    return sum;
}

Sample patch_at(double x, double y, double z, double side_m) {
    const auto half = static_cast<float>(0.5 * side_m);
    const auto range = static_cast<float>(std::sqrt(x * x + y * y + z * z));
    return {.position = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)},
            .edge_u = {0.0F, half, 0.0F},
            .edge_v = {0.0F, 0.0F, half},
            .normal = {-1.0F, 0.0F, 0.0F},
            .height_m = range,
            .area_m2 = 4.0F * half * half,
            .material = 0,
            .instance = 0};
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
        // 100 wavelengths of 1 mm: L = 0.1 m, L^2 / lambda = 10 m. At r the amplitude on the axis
        // is (C(w) - i S(w)) / w, w = L / sqrt(2 lambda r), with sign by the sense of the phase.
        LineArray array;
        array.wavelengths = 100.0;
        const double wavelength = 1e-3;
        // r = L^2 / (2 lambda) = 5 m: w = 1, C(1) = 0.7798934, S(1) = 0.4382591.
        const double near = std::abs(unfocused_pattern(array, 0.0, wavelength, 1.0 / 5.0));
        CHECK(std::fabs(near / std::hypot(0.7798934, 0.4382591) - 1.0) < 2e-3);
        // Far away nothing of it is left.
        CHECK(std::fabs(std::abs(unfocused_pattern(array, 0.0, wavelength, 0.0)) - 1.0) < 1e-9);
    }

    TEST_CASE("near field: the beam is as wide as the array is long") {
        LineArray array;
        array.wavelengths = 200.0;
        const double wavelength = 1e-3;  // 0.2 m; the far field begins beyond 40 m
        const UnfocusedBeam beam = unfocused_beam(array, wavelength, 4.0, 0.05);
        const double axis = std::abs(beam.at(0.0F, 4.0F));
        // 0.07 m and 0.17 m off the axis, 4 m away, in front of the array and beyond its end.
        CHECK(std::abs(beam.at(0.07F / 4.0F, 4.0F)) > 0.5 * axis);
        CHECK(std::abs(beam.at(0.17F / 4.0F, 4.0F)) < 0.1 * axis);
    }

    TEST_CASE("near field: the table is the pattern") {
        const LineArray array = line_array(radians(0.5), -20.0);
        const double wavelength = 2e-3;
        const UnfocusedBeam beam = unfocused_beam(array, wavelength, 2.0, 0.03);
        const double peak = std::norm(unfocused_pattern(array, 0.0, wavelength, 1.0 / 20.0));
        for (const double u : {-0.021, -0.004, 0.0013, 0.0077}) {
            const std::complex<double> one_way =
                unfocused_pattern(array, u, wavelength, 1.0 / 20.0);
            const std::complex<double> entry = beam.at(static_cast<float>(u), 20.0F);
            CHECK(std::abs(entry - one_way * one_way) < 0.02 * peak);
        }
    }

    TEST_CASE("echosounder: a small plate off the axis is weighed by the disc's pattern") {
        const CalibratedModel model = sounder(10.0);
        const double on_axis = energy_of(model, {patch_at(5.0, 0.0, 0.0, 0.01)});
        REQUIRE(on_axis > 0.0);
        // In y or in z at half of the width, the power is a quarter there and back. The same angle
        // of grazing takes a plate on an arc; let it face the sonar.
        const double angle = radians(5.0);
        for (const bool up : {false, true}) {
            const double across = 5.0 * std::sin(angle);
            Sample off =
                patch_at(5.0 * std::cos(angle), up ? 0.0 : across, up ? across : 0.0, 0.01);
            off.normal = -off.position.normalized();
            const double ratio = energy_of(model, {off}) / on_axis;
            CHECK(std::fabs(ratio / 0.25 - 1.0) < 0.02);
        }
    }
}
