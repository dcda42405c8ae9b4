#include "core/resampling.h"

#include <doctest/doctest.h>

#include <limits>
#include <numeric>

#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("resampling: the variance of a mean, by counts and by weights") {
        // The mean of the numbers 1 to n. Their variance is (n^2 - 1) / 12; that of the mean is an
        // n-th of it with counts, and an (n + 1)-th with exponential weights.
        constexpr int n = 20;
        constexpr int draws = 4000;
        const auto mean = [](const std::vector<double>& weights) {
            double sum = 0.0;
            for (std::size_t k = 0; k < weights.size(); ++k)
                sum += weights[k] * static_cast<double>(k + 1);
            return sum / std::accumulate(weights.begin(), weights.end(), 0.0);
        };
        const auto both = [&](std::uint32_t draw) {
            const std::vector<double> counts = drawn_counts(n, {draw, 1});
            CHECK(std::accumulate(counts.begin(), counts.end(), 0.0) == n);
            std::vector<double> weights;
            for (std::uint32_t k = 0; k < n; ++k)
                weights.push_back(drawn_weight({draw, k, 0, 0}, {2, 2}));
            const double none = std::numeric_limits<double>::quiet_NaN();
            return std::vector<double>{mean(counts), mean(weights), draw % 2 == 0 ? none : 3.0};
        };
        const std::vector<double> found = drawn_variances({10.5, 10.5, 3.0}, draws, both);
        // The variance of so many draws scatters by sqrt(2 / 4000), 2.2 %; five times that is
        // passed in 6 of ten million runs.
        const double variance = (n * n - 1.0) / 12.0;
        CHECK(found[0] == test::approx(variance / n).epsilon(0.11));
        CHECK(found[1] == test::approx(variance / (n + 1)).epsilon(0.11));
        CHECK(found[2] == 0.0);  // half of its draws have no number
    }
}
