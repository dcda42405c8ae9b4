#include "calibrate/log_statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "calibrate/made_pings.h"
#include "core/normal_pair.h"
#include "core/units.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Pairs of complex normal amplitudes with the correlation `rho`.
struct LogPairs {
    std::vector<double> a, b;

    LogPairs(int looks, double rho, int count) {
        const PhiloxKey key =
            stream_key(3, 1, static_cast<std::uint32_t>(looks), stream_named("log pairs"));
        for (int k = 0; k < count; ++k) {
            double power_a = 0.0;
            double power_b = 0.0;
            for (int look = 0; look < looks; ++look) {
                const PhiloxBlock block = philox(
                    {static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(look), 0, 0}, key);
                const auto one = normal_pair(block.x0);
                const auto two = normal_pair(block.x1);
                const std::complex<double> x(one.first, one.second);
                const std::complex<double> y(two.first, two.second);
                power_a += std::norm(x);
                power_b += std::norm(rho * x + std::sqrt(1.0 - rho * rho) * y);
            }
            a.push_back(std::log(power_a / (2.0 * looks)));
            b.push_back(std::log(power_b / (2.0 * looks)));
        }
    }
};

double mean_of_powers(const std::vector<double>& x, double about, int exponent) {
    double sum = 0.0;
    for (const double value : x)
        sum += std::pow(value - about, exponent);
    return sum / static_cast<double>(x.size());
}

}  // namespace

TEST_SUITE("calibrate") {
    TEST_CASE("log statistics: those of one look are known numbers") {
        CHECK(log_power_variance(1) == test::approx(pi * pi / 6.0));
        // -12 sqrt(6) zeta(3) / pi^3, the skewness of Gumbel's distribution.
        CHECK(log_power_skewness(1) == test::approx(-1.1395471).epsilon(1e-6));
        // sqrt(4 / pi - 1).
        CHECK(amplitude_variation(1) == test::approx(0.5227232).epsilon(1e-6));
        CHECK(amplitude_variation(2) == test::approx(0.363).epsilon(2e-3));
        CHECK(log_power_correlation(1.0, 1) == 1.0);
        CHECK(log_power_correlation(0.0, 3) == 0.0);
        // The dilogarithm of 1/2 is pi^2 / 12 - ln(2)^2 / 2.
        const double half = pi * pi / 12.0 - 0.5 * std::log(2.0) * std::log(2.0);
        CHECK(log_power_correlation(0.5, 1) == test::approx(half / (pi * pi / 6.0)));
    }

    TEST_CASE("log statistics: drawn powers have them") {
        // 200,000 pairs: the standard errors are 0.003 of mean and correlation and 0.006 of the
        // variance. Twelve checks within 5 of them fail once in 100,000 runs by chance.
        for (const int looks : {1, 2, 4}) {
            CAPTURE(looks);
            const double rho = 0.8;
            const LogPairs pairs(looks, rho, 200000);
            const double mean = mean_of_powers(pairs.a, 0.0, 1);
            const double variance = mean_of_powers(pairs.a, mean, 2);
            CHECK(std::fabs(mean - log_power_mean(looks)) < 0.015);
            CHECK(std::fabs(variance - log_power_variance(looks)) < 0.03);
            const double skewness = mean_of_powers(pairs.a, mean, 3) / std::pow(variance, 1.5);
            CHECK(std::fabs(skewness - log_power_skewness(looks)) < 0.05);
            double product = 0.0;
            for (std::size_t k = 0; k < pairs.a.size(); ++k)
                product += (pairs.a[k] - mean) * (pairs.b[k] - mean) / 200000.0;
            const double expected = log_power_correlation(rho * rho, looks);
            CHECK(std::fabs(product / variance - expected) < 0.015);
        }
    }
}
