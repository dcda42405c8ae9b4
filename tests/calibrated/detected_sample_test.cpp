#include "simulate/calibrated/receiver/receiver_chain.h"
#include "support/statistics.h"

namespace {

ReceiverConfig receiver(double samples, SampleRule rule, double expansion = 1.0) {
    ReceiverConfig out;
    out.samples = samples;
    out.combine = rule;
    out.expansion = expansion;
    return out;
}

/// The delivered power of one sample of the power x, both in units of the mean 3.
double delivered(const ReceiverConfig& config, double x) {
    constexpr float mean = 3.0F;
    std::vector<float> power{static_cast<float>(x) * mean};
    DetectedSample(config).apply(std::vector<float>{mean}, power);
    return static_cast<double>(power[0] / mean);
}

/// Exponential powers, as speckle has them, after the receiver; their mean is 1.
std::vector<double> speckle(const ReceiverConfig& config) {
    std::mt19937 draws(11);
    std::exponential_distribution<float> exponential_draw;
    std::vector<float> power(200000);
    for (float& x : power)
        x = exponential_draw(draws);
    DetectedSample(config).apply(std::vector<float>(power.size(), 1.0F), power);
    return {power.begin(), power.end()};
}

}  // namespace

TEST_CASE("detected sample: one sample stays, and several keep the mean") {
    CHECK_FALSE(DetectedSample(receiver(1.0, SampleRule::maximum)).changes());
    for (const ReceiverConfig& config :
         {receiver(2.0, SampleRule::maximum), receiver(14.0, SampleRule::maximum),
          receiver(3.5, SampleRule::mean), receiver(9.0, SampleRule::maximum, 1.75)}) {
        // The variance is at most that of exponential powers: 5 standard errors.
        CHECK(std::fabs(mean(speckle(config)) - 1.0) < 5.0 / std::sqrt(200000.0));
    }
}

TEST_CASE("detected sample: the largest of n has the quantile of the sample's rank") {
    // (1 - e^-v)^n = 1 - e^-x, and the mean of the largest of n is 1 + 1/2 + ... + 1/n.
    for (const int n : {2, 5, 14}) {
        double harmonic = 0.0;
        for (int k = 1; k <= n; ++k)
            harmonic += 1.0 / k;
        for (const double x : {1e-6, 1e-3, 0.1, 0.7, 2.0, 9.0, 30.0}) {
            const double v = harmonic * delivered(receiver(n, SampleRule::maximum), x);
            // ln of 1 - (1 - e^-v)^n, without cancellation where that is small.
            const double ln_above = std::log(-std::expm1(n * std::log1p(-std::exp(-v))));
            CAPTURE_ALL(n, x);
            CHECK(std::fabs(-ln_above / x - 1.0) < (x < 1e-2 ? 0.02 : 1e-3));
        }
    }
}

TEST_CASE("detected sample: the mean of two has the quantile of the gamma distribution") {
    // P(sum > z) = e^-z (1 + z) = e^-x, and the mean of two is z / 2.
    for (const double x : {0.05, 0.7, 2.0, 9.0, 25.0}) {
        const double z = 2.0 * delivered(receiver(2.0, SampleRule::mean), x);
        CAPTURE(x);
        CHECK(std::fabs((z - std::log1p(z)) / x - 1.0) < 2e-3);
    }
}

TEST_CASE("detected sample: an expansion raises the power of the sample to it") {
    const auto over_median = [](double expansion, double x) {
        const ReceiverConfig config = receiver(9.0, SampleRule::maximum, expansion);
        return delivered(config, x) / delivered(config, std::log(2.0));
    };
    for (const double x : {0.01, 0.3, 3.0, 9.0}) {
        CAPTURE(x);
        CHECK(over_median(1.75, x) == approx(std::pow(over_median(1.0, x), 1.75)).epsilon(1e-3));
    }
}
