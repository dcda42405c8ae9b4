#include "validation/fit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("validation");

TEST_CASE("the Pareto front keeps what nothing beats") {
    const std::vector<double> cost{1.0, 2.0, 3.0, 2.0, 4.0};
    const std::vector<double> error{0.5, 0.2, 0.3, 0.2, 0.1};
    // (2, 0.2) dominates (3, 0.3); two equal points do not dominate each other.
    CHECK(pareto_front(cost, error) == std::vector<bool>{true, true, false, true, true});
    CHECK(pareto_front({}, {}).empty());
}

TEST_CASE("an exponent is found again") {
    const std::vector<double> x{1e3, 1e4, 1e5, 1e6};
    std::vector<double> y;
    for (const double v : x)
        y.push_back(0.7 * std::pow(v, 0.3));
    CHECK(fit_exponent(x, y) == test::approx(0.3));
    // Worked example: log2 y = 0, 1, 1 at log2 x = 0, 1, 2 has the least-squares slope 1/2.
    CHECK(fit_exponent(std::vector{1.0, 2.0, 4.0}, std::vector{1.0, 2.0, 2.0}) ==
          test::approx(0.5));
    CHECK(std::isnan(fit_exponent(std::vector{2.0, 2.0}, std::vector{1.0, 3.0})));
    CHECK(std::isnan(fit_exponent(std::vector{1.0, 2.0}, std::vector{0.0, 3.0})));
}

TEST_SUITE_END();
