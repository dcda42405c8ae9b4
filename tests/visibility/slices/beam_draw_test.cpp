#include "visibility/slices/beam_draw.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/sanitized.h"

using namespace sonarsim;

TEST_CASE("slices: drawn beams with any rates estimate a sum without bias") {
    // Values that grow with the rate, so that equal weights would be biased. A beam is drawn n
    // times with the mean `rate`, so n / rate has the mean 1. Each unit of rates has one point,
    // uniform in it: the estimate from a unit has at most the variance of one draw from it, the
    // mean of (value / rate)^2 over the unit.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.03, 1.0);
    const int beams = test::sanitized ? 20'000 : 200'000;
    BeamDraw draw(3);
    double estimate = 0.0;
    double sum = 0.0;
    double variance = 0.0;
    for (int i = 0; i < beams; ++i) {
        const double rate = any(random);
        const double value = rate * rate + any(random);
        estimate += draw.weight(rate) * value;
        sum += value;
        variance += value * value / rate;
    }
    // 4 standard deviations: 1 of 16,000.
    CHECK(std::fabs(estimate - sum) < 4.0 * std::sqrt(variance));
    CHECK(std::sqrt(variance) < 0.02 * sum);  // else the test could hardly fail
}

TEST_CASE("slices: beams are drawn as often as their rates say, one in each unit") {
    BeamDraw draw(3);
    double rates = 0.0;
    double draws = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double rate = i < 500 ? 0.05 : 0.4;
        draws += draw.weight(rate) * rate;
        rates += rate;
        REQUIRE(std::fabs(draws - rates) < 1.0 + 1e-9);
    }
}

TEST_CASE("slices: a beam with a rate of 1 stands for itself alone") {
    BeamDraw draw(3);
    for (int i = 0; i < 100; ++i) {
        REQUIRE(draw.weight(1.0) == 1.0);
        REQUIRE(draw.weight(7.5) == 1.0);
    }
}
