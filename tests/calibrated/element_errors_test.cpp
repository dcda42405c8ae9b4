#include "simulate/calibrated/equation/sonar_equation.h"
#include "simulate/calibrated/signal/directivity.h"
#include "support/calibrated.h"
#include "support/patches.h"

namespace {

constexpr ElementsConfig errors{.gain_error_db = 0.5, .phase_error_deg = 3.0, .serial = 0};

}  // namespace

// The powers about a null are exponential: the mean of 300 x 5 is known to 2.6 %; 4 sigma.
TEST_CASE("element errors: the mean side lobe is their variance over the elements") {
    for (const double side_lobe_db : {-13.3, -30.0}) {
        const LineArray array = line_array(radians(1.0), side_lobe_db);
        double sum = 0.0;
        double expected = 0.0;
        for (int serial = 0; serial < 300; ++serial) {
            ElementsConfig drawn = errors;
            drawn.serial = serial;
            for (const double lobe : {7.0, 19.0, 31.0, 43.0, 55.0}) {
                const double u = lobe / array.wavelengths;
                sum += std::norm(PatternWithErrors(array, drawn)(u));
                expected += mean_side_lobe(array, errors);
            }
        }
        CHECK(sum == approx(expected).epsilon(0.11));
    }
}

TEST_CASE("element errors: each instrument and each of its arrays has its own") {
    const LineArray array = line_array(radians(2.0), -20.0);
    for (const double u : {0.0, 0.01, 0.1, 0.7}) {
        CHECK(std::abs(PatternWithErrors(array, {})(u) - line_pattern(array, u)) < 1e-12);
    }
    const auto one = element_errors(errors, 50);
    CHECK(one == element_errors(errors, 50));
    ElementsConfig other = errors;
    other.serial = 1;
    CHECK(one != element_errors(other, 50));
}

// A point straight ahead, in the beams of 30 instruments. Beams two lobes apart are
// independent: the mean of 30 times 20 powers is known to 4.1 %.
TEST_CASE("element errors: the side lobes of the beams are those of the elements") {
    InstrumentConfig config = bare({});
    config.beam.width_deg = 2.0;
    config.beam.side_lobe_db = -40.0;
    const View view{radians(90.0), radians(20.0), 4.0, 6.0, 40, 61, 0.03};
    BeamSines sines;
    for (int k = 0; k <= 122; ++k)
        (k % 2 == 0 ? sines.edges : sines.middles).push_back(0.707 * (k / 61.0 - 1.0));
    Samples samples;
    samples.items = {plate_ahead(5.0, 2e-4)};
    // The mean of the outer beams over the beam ahead.
    const auto side_lobes = [&] {
        const CalibratedModel model = calibrated_model(config, {}, view, sines);
        const std::vector<float> image = image_of_samples(model, view, samples, {});
        const float* const row = image.data() + std::size_t{20} * 61;
        double sum = 0.0;
        for (int beam = 0; beam < 61; ++beam)
            sum += std::abs(beam - 30) < 8 ? 0.0 : row[beam];
        return sum / 46.0 / row[30];
    };
    const double without = side_lobes();
    config.beam.elements = errors;
    double with = 0.0;
    for (int serial = 0; serial < 30; ++serial) {
        config.beam.elements.serial = serial;
        with += side_lobes() / 30.0;
    }
    const LineArray array = line_array(radians(2.0), -40.0);
    CHECK(with - without == approx(mean_side_lobe(array, errors)).epsilon(0.17));
}

TEST_CASE("element errors: nulls in elevation fill") {
    const auto lowest = [](const SineTable& pattern) {
        return *std::min_element(pattern.values.begin() + 512, pattern.values.begin() + 1536);
    };
    const double floor = mean_side_lobe(line_array(radians(20.0), -13.3), errors);
    CHECK(lowest(elevation_pattern(radians(20.0), -13.3)) < 1e-5F);
    CHECK(lowest(elevation_pattern(radians(20.0), -13.3, errors)) == approx(floor).epsilon(0.02));
}
