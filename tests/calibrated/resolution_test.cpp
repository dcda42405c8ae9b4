#include "calibrated/preset_fixtures.h"
#include "core/decibel.h"
#include "simulate/product/scan.h"

namespace {

double half_power_width(const Eigen::ArrayXd& values) {
    Eigen::Index peak = 0;
    values.maxCoeff(&peak);
    const double half = 0.5 * values[peak];
    Eigen::Index low = peak;
    while (values[low] > half)
        --low;
    Eigen::Index high = peak;
    while (values[high] > half)
        ++high;
    const double from = low + (half - values[low]) / (values[low + 1] - values[low]);
    return high - (half - values[high]) / (values[high - 1] - values[high]) - from;
}

/// The half-power width of an aperture with errors of phase, as a sine, by the transform.
double aperture_width(const LineArray& array) {
    Eigen::ArrayXd pattern(601);
    constexpr double step = 0.01;  // in lambda / L
    for (int i = -300; i <= 300; ++i) {
        pattern[i + 300] = std::norm(integral(-0.5, 0.5, 200, [&](double x) {
            return array.weight(x) * std::polar(1.0, 2.0 * pi * x * i * step);
        }));
    }
    return half_power_width(pattern) * step / array.wavelengths;
}

}  // namespace

TEST_CASE("resolution cell of three presets: a point is as wide as beam and pulse are") {
    struct Case {
        std::string preset;
        double range_m, resolution_m;
    };
    for (const Case& c : {Case{"oculus_m1200d_2100khz", 1.2, 0.0025},
                          Case{"gemini_720is", 3.0, 0.008}, Case{"didson_1800khz", 5.0, 0.02}}) {
        CAPTURE(c.preset);
        // 120 beams over 6 degrees; 60 bins of a quarter of the resolution.
        const Sonar sonar = preset_sonar(
            c.preset,
            "    azimuth_deg: 6\n    azimuth_bins: 121\n    range_bins: 61\n"
            "    range_min_m: " +
                std::to_string(c.range_m - 7.625 * c.resolution_m) +
                "\n    range_max_m: " + std::to_string(c.range_m + 7.625 * c.resolution_m) +
                "\n    instrument: {usual_water: none, receiver: {samples: 1}, "
                "beam: {elements: {gain_error_db: 0, phase_error_deg: 0}}}\n");
        Samples point;
        point.items = {plate_ahead(c.range_m, 1e-4)};
        const std::vector<float> image = quiet_image(sonar, point, false);
        const Eigen::ArrayXXd rows = image_array(image, 121).cast<double>();
        Eigen::Index bin = 0;
        Eigen::Index beam = 0;
        rows.maxCoeff(&bin, &beam);

        // Without errors of phase this is the width that the preset asks for.
        const LineArray array = array_of(sonar);
        const double width = aperture_width(array);
        if (array.quartic_rad == 0.0)
            CHECK(std::fabs(width / radians(sonar.config.instrument.beam.width_deg) - 1.0) < 2e-3);
        const double spacing = 2.0 * std::sin(radians(3.0)) / 121.0;
        const double beams_m = half_power_width(rows.row(bin).transpose()) * spacing;
        const double pulse_m = half_power_width(rows.col(beam)) * sonar.settings.view.bin_m();
        CHECK(std::fabs(beams_m / width - 1.0) < 0.02);
        // The linear spline that stands for the pulse is higher than it at its knots.
        CHECK(std::fabs(pulse_m / c.resolution_m - 1.0) < 0.03);
    }
}

TEST_CASE("beam of a fan: a point that passes it finds its width at the preset's number of beams") {
    for (const char* const preset : {"oculus_m1200d_2100khz", "oculus_m1200d_1200khz"}) {
        CAPTURE(preset);
        const Sonar sonar =
            preset_sonar(preset,
                         "    range_bins: 9\n    range_min_m: 4.9\n    range_max_m: 5.1\n"
                         "    instrument: {usual_water: none, receiver: {samples: 1}, "
                         "beam: {elements: {gain_error_db: 0, phase_error_deg: 0}}}\n");
        const double width = aperture_width(array_of(sonar));
        Eigen::ArrayXd passed(81);
        for (int i = 0; i < 81; ++i) {
            const double sine = 0.05 * width * (i - 40);
            Samples point;
            point.items = {plate_ahead(5.0, 1e-4)};
            point.items[0].position.y() = static_cast<float>(5.0 * sine);
            const int beams = sonar.settings.view.beams;
            passed[i] = image_array(quiet_image(sonar, point, false), beams).col(beams / 2).sum();
        }
        CHECK(std::fabs(half_power_width(passed) * 0.05 - 1.0) < 0.03);
    }
}

TEST_CASE("scanning: a point is smeared over the steps as the two-way beam is") {
    for (const char* const preset : {"micron", "ping360"}) {
        // Short pings, and steps of half a degree over 24 degrees.
        const Sonar sonar = preset_sonar(
            preset,
            "    range_min_m: 1\n    range_max_m: 8\n    range_bins: 140\n"
            "    sector_deg: 24\n    step_deg: 0.5\n"
            "    instrument: {usual_water: none, speckle: {mode: none}, receiver: {tvg_log: 0}}\n");
        const LineArray head = array_of(sonar);
        const double width = radians(sonar.config.instrument.beam.width_deg);
        const double half_view = 0.5 * sonar.settings.view.azimuth_rad;
        const auto level = [&](double off) {
            const Pose pose{rotation_from_rpy(0.0, 0.0, off), Eigen::Vector3d::Zero()};
            const Samples point =
                patches({5.0, 0.0, 0.0}, {0, -1, 0}, {0, 0, 1}, 0.002, 0.002, 0.002, pose);
            return db_of_power(total(quiet_image(sonar, point, false, pose)));
        };
        const double ahead = level(0.0);
        // At half of the width a quarter of the power is left.
        CHECK(std::fabs(level(0.5 * width) - ahead + 6.02) < 0.05);
        CHECK(std::fabs(level(-0.5 * width) - ahead + 6.02) < 0.05);
        int lobes = 0;
        for (const double angle : scan_angles_rad(sonar.config)) {
            if (std::fabs(angle) >= half_view) continue;
            // One way the loss is the array's pattern.
            const double expected =
                4.0 * db_of_power(std::fabs(line_pattern(head, std::sin(angle))));
            if (expected < -60.0) continue;  // in a null
            CHECK(std::fabs(level(angle) - ahead - expected) < 0.2);
            // The first side lobes are 20 dB down one way.
            lobes += std::fabs(angle) > 1.2 * width && expected > -41.0 ? 1 : 0;
        }
        CHECK(lobes >= 4);
    }
}
