#include "simulate/calibrated/detected_sample.h"

#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

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

TEST_CASE("detected sample: speckle has the variation and the skewness of its samples") {
    // Amplitudes of the largest of two exponential powers, by numerical integration: variation
    // 0.378; the skewness of their logarithms -0.72. Nine samples stretched by 1.75 have 0.38 and
    // -0.11.
    const auto figures = [](const ReceiverConfig& config) {
        std::vector<double> amplitude, logarithms;
        for (const double power : speckle(config)) {
            amplitude.push_back(std::sqrt(power));
            logarithms.push_back(std::log(power));
        }
        const double average = mean(logarithms);
        const double amplitude_mean = mean(amplitude);
        double m2 = 0.0;
        double m3 = 0.0;
        double a2 = 0.0;
        for (std::size_t k = 0; k < logarithms.size(); ++k) {
            m2 += std::pow(logarithms[k] - average, 2.0);
            m3 += std::pow(logarithms[k] - average, 3.0);
            a2 += std::pow(amplitude[k] / amplitude_mean - 1.0, 2.0);
        }
        const auto count = static_cast<double>(logarithms.size());
        return std::pair(std::sqrt(a2 / count), m3 / count / std::pow(m2 / count, 1.5));
    };
    const auto [variation, skewness] = figures(receiver(2.0, SampleRule::maximum));
    CHECK(std::fabs(variation - 0.378) < 0.005);
    CHECK(std::fabs(skewness + 0.72) < 0.03);
    const auto [stretched, symmetric] = figures(receiver(9.0, SampleRule::maximum, 1.75));
    CHECK(std::fabs(stretched - 0.38) < 0.02);
    CHECK(std::fabs(symmetric + 0.11) < 0.03);
}
