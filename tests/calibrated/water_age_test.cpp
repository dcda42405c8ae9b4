#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "calibrated/model.h"
#include "core/units.h"
#include "support/approx.h"
#include "support/calibrated.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// An echosounder's, with bins of 0.1 m.
const View aging_view{.azimuth_rad = radians(40.0),
                      .elevation_rad = radians(40.0),
                      .range_min_m = 2.0,
                      .range_max_m = 22.0,
                      .range_bins = 200,
                      .beams = 1,
                      .relative_l1 = 0.03,
                      .shape = ViewShape::cone};

CalibratedModel aging_water(SpeckleMode mode) {
    InstrumentConfig config = bare({});
    config.frequency_hz = 2e5;
    config.beam.aperture = Aperture::piston;
    config.beam.width_deg = 7.0;
    config.pulse.resolution_m = 0.2;
    config.speckle.mode = mode;
    WaterConfig water;
    water.scattering_db_per_m3 = -60.0;
    return calibrated_model(config, water, aging_view, {});
}

}  // namespace

TEST_SUITE("calibrated") {
    // With a and b the ages of two pings and w the weights of the draws of whole ages, amplitudes
    // have the correlation r = sum w(a) w(b), and powers, of normal amplitudes, r^2. 45 bins in
    // each of 40 seeds and 5 pairs of ages: for exponential powers of the mean 1 the variance of
    // (I_a - 1) (I_b - 1) is 8 for r = 1 and 1 for r = 0, so 9,000 such products have a mean within
    // 0.12 and 0.042 (4 sigma); in between it is below 1 + 7 r^2.
    TEST_CASE("water: its speckle changes with its age") {
        const View& view = aging_view;
        const CalibratedModel model = aging_water(SpeckleMode::scene);
        const std::vector<float> expected =
            image_of_traced(aging_water(SpeckleMode::none), view, {}, {}, {1, 2, 0});
        const auto weight = [](double whole, double age) {
            const double past = age - whole;
            return past > -1.0 && past < 1.0 ? std::cos(0.5 * pi * past) : 0.0;
        };
        for (const double apart : {0.0, 0.3, 0.6, 1.0, 1.5, 2.0}) {
            double product = 0.0;
            double predicted = 0.0;
            for (int k = 0; k < 5; ++k) {
                const double first = 0.1 + 0.2 * k;
                double r = 0.0;
                for (int whole = 0; whole < 5; ++whole)
                    r += weight(whole, first) * weight(whole, first + apart);
                predicted += 0.2 * r * r;
                for (std::uint64_t seed = 0; seed < 40; ++seed) {
                    TracedPing traced;
                    traced.water_age = first;
                    const PingDraws draws{40 * k + seed, 2, 0};
                    const auto before = image_of_traced(model, view, traced, {}, draws);
                    traced.water_age = first + apart;
                    const auto after = image_of_traced(model, view, traced, {}, {draws.seed, 2, 1});
                    for (int row = 10; row < 190; row += 4) {
                        if (apart == 0.0)
                            CHECK(after[row] == test::approx(before[row]).epsilon(1e-4));
                        product += (before[row] / expected[row] - 1.0) *
                                   (after[row] / expected[row] - 1.0) / 9000.0;
                    }
                }
            }
            MESSAGE(apart, " ages apart: ", product, ", by the weights ", predicted);
            CHECK(std::fabs(product - predicted) < 0.042 * std::sqrt(1.0 + 7.0 * predicted));
        }
    }
}
