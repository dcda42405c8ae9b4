#include "calibrate/array_fit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "calibrate/made_pings.h"
#include "calibrate/pulse_fit.h"
#include "calibrated/range_response.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrate") {
    TEST_CASE("arrays: the correlation of beams is the transform of the squared weights") {
        for (const double side_lobe_db : {-13.3, -20.0, -35.0}) {
            const LineArray array = line_array(radians(1.2), side_lobe_db);
            for (const double u : {0.0, 0.004, 0.011, 0.03}) {
                // The integral, by the rule of midpoints.
                std::complex<double> sum = 0.0;
                double whole = 0.0;
                constexpr int steps = 4000;
                for (int k = 0; k < steps; ++k) {
                    const double x = (k + 0.5) / steps - 0.5;
                    const double w2 = std::norm(array.weight(x));
                    sum += w2 * std::polar(1.0, 2.0 * pi * u * array.wavelengths * x);
                    whole += w2;
                }
                const double expected = std::norm(sum / whole);
                CHECK(beam_correlation(array, u) == test::approx(expected).epsilon(1e-5));
            }
        }
    }

    TEST_CASE("arrays: width and taper are found in the correlations that they predict") {
        std::vector<double> sines;
        for (int j = 0; j < 96; ++j)
            sines.push_back(0.008 * (j - 47.5));
        for (const double side_lobe_db : {-16.0, -22.0, -30.0}) {
            CAPTURE(side_lobe_db);
            const LineArray array = line_array(radians(1.1), side_lobe_db);
            const auto seen = predicted_beam_correlations(array, sines, log_statistics(1));
            BeamCorrelations exact;
            exact.mean = Eigen::Map<const Eigen::Matrix<double, patch_lags, 1>>(seen.data());
            exact.covariance.setZero();
            exact.units = 1000;
            const std::optional<ArrayFit> found = fit_array(exact, sines, log_statistics(1));
            REQUIRE(found.has_value());
            const ArrayFit& fit = *found;
            exact.units = 23;
            CHECK_FALSE(fit_array(exact, sines, log_statistics(1)).has_value());
            CHECK(std::fabs(fit.width_deg.value - 1.1) < 0.02);
            CHECK(std::fabs(fit.side_lobe_db.value - side_lobe_db) < 1.5);
        }
    }

    TEST_CASE("arrays: intervals hold the true width and taper in 95 of 100 cases") {
        // Correlations of 300 units with a known covariance, which a drawn sample of them
        // estimates.
        std::vector<double> sines;
        for (int j = 0; j < 96; ++j)
            sines.push_back(0.008 * (j - 47.5));
        Draws draws(3);
        int held = 0;
        constexpr int cases = 25;
        for (int k = 0; k < cases; ++k) {
            const double width_deg = draws.between(0.7, 1.6);
            const double side_lobe_db = draws.between(-34.0, -14.0);
            const auto exact = predicted_beam_correlations(
                line_array(radians(width_deg), side_lobe_db), sines, log_statistics(1));
            std::vector<PatchMoments> patches(300);
            std::vector<std::size_t> chosen;
            for (std::size_t p = 0; p < patches.size(); ++p) {
                const double common = draws.between(-0.15, 0.15);
                patches[p].variance = 1.0;
                for (std::size_t lag = 0; lag < patch_lags; ++lag)
                    patches[p].along_beams[lag] =
                        1.0 - exact[lag] + common + draws.between(-0.1, 0.1);
                chosen.push_back(p);
            }
            const auto fit =
                fit_array(beam_correlations(patches, chosen, true), sines, log_statistics(1));
            REQUIRE(fit.has_value());
            held += fit->width_deg.holds(width_deg) ? 1 : 0;
            held += fit->side_lobe_db.holds(side_lobe_db) ? 1 : 0;
        }
        // 50 intervals: 43 or fewer of 95 % in one case of 2,000.
        CHECK(held >= 44);
    }

    TEST_CASE("pulses: the noise of bins is correlated as the taps of the model") {
        // A white sequence behind taps t has the correlation sum t(k) t(k + l) / sum t^2.
        const std::vector<float> taps = noise_taps(2.0, -30.0);
        double sum = 0.0;
        for (std::size_t k = 0; k + 1 < taps.size(); ++k)
            sum += static_cast<double>(taps[k]) * taps[k + 1];
        const auto lags = PulseModel{.receiver = {}, .kind = ReceivedKind::noise}.correlations(2.0);
        // Li2(x) / Li2(1) at x = sum^2, by its series.
        double expected = 0.0;
        for (int j = 1; j < 60; ++j)
            expected += std::pow(sum * sum, j) / (j * j) / (pi * pi / 6.0);
        CHECK(lags[0] == test::approx(expected).epsilon(1e-3));
        // Echoes of many scatterers are correlated farther than noise.
        const auto echo =
            PulseModel{.receiver = {}, .kind = ReceivedKind::echo_of_bins}.correlations(2.0);
        CHECK(echo[1] > lags[1]);
    }
}
