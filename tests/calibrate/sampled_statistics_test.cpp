#include "calibrate/sampled_statistics.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

ReceiverConfig receiver_of(int samples, SampleRule rule) {
    ReceiverConfig out;
    out.samples = samples;
    out.combine = rule;
    return out;
}

const std::vector<double> independent_samples{1.0};

}  // namespace

TEST_SUITE("calibrate") {
    TEST_CASE("sampled statistics: the larger of two independent samples has closed forms") {
        // P(max < x) = (1 - e^-x)^2, so its density is 2 e^-x - 2 e^-2x: twice that of one sample
        // less that of a sample of half the power. With g Euler's constant, E ln P = -2 g + (g + ln
        // 2), and E (ln P)^2 = 2 (pi^2 / 6 + g^2) - (pi^2 / 6 + (g + ln 2)^2).
        const double euler = 0.57721566490153286;
        const double halved = euler + std::log(2.0);
        const double mean = -2.0 * euler + halved;
        const double square =
            2.0 * (pi * pi / 6.0 + euler * euler) - (pi * pi / 6.0 + halved * halved);
        const LogStatistics two =
            sampled_statistics(receiver_of(2, SampleRule::maximum), independent_samples);
        // 80,000 fixed draws: standard errors of 0.003 and 0.006 at most.
        CHECK(std::fabs(two.mean - mean) < 0.012);
        CHECK(std::fabs(two.variance - (square - mean * mean)) < 0.02);
    }

    TEST_CASE("sampled statistics: the root mean square of samples is that of looks") {
        const LogStatistics samples =
            sampled_statistics(receiver_of(3, SampleRule::rms), independent_samples);
        const LogStatistics looks = log_statistics(3);
        CHECK(std::fabs(samples.mean - looks.mean) < 0.012);
        CHECK(std::fabs(samples.variance - looks.variance) < 0.02);
        CHECK(std::fabs(samples.skewness - looks.skewness) < 0.05);
        CHECK(std::fabs(samples.variation - looks.variation) < 0.005);
        for (const double k2 : {0.1, 0.4, 0.8})
            CHECK(std::fabs(samples.correlation(k2) - looks.correlation(k2)) < 0.015);
        CHECK(std::fabs(samples.correlation(0.0)) < 0.01);
        CHECK(samples.correlation(1.0) == test::approx(1.0).epsilon(0.001));
    }

    TEST_CASE("sampled statistics: a pulse of many samples makes them one") {
        const std::vector<double> long_pulse(200, 1.0);
        const LogStatistics two =
            sampled_statistics(receiver_of(2, SampleRule::maximum), long_pulse);
        // Neighbours have the correlation 0.995. Independent ones would take 0.9 of the variance.
        CHECK(std::fabs(two.variance - log_power_variance(1)) < 0.3);
        CHECK(std::fabs(two.mean - log_power_mean(1)) < 0.1);
    }

    TEST_CASE("sampled statistics: independent bins stay independent") {
        for (const double lag :
             sampled_range_correlations(receiver_of(2, SampleRule::maximum), independent_samples)) {
            // 20,000 bins: four standard errors, the correction's included.
            CHECK(std::fabs(lag) < 0.04);
        }
    }
}
