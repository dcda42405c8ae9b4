#include "product/detect_return.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "product/range_bias.h"
#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("product");

TEST_CASE("detect return: a bright stretch of any place and length is found exactly") {
    // A run that is one bin longer or shorter than a stretch of n bins of brightness b over m bins
    // of 0 in all has the contrast b n (1 - n / m) / sqrt(n) times sqrt(n / (n + 1)), or times
    // sqrt((n - 1) / n) and less: the stretch itself is the best.
    for (const int length : {1, 2, 3, 5, 9, 17, 40}) {
        for (int begin = 0; begin + length <= 100; begin += 7) {
            std::vector<double> beam(100, 0.25);
            std::fill_n(beam.begin() + begin, length, 0.75);
            const DetectedReturn run = detect_return(beam);
            CAPTURE(length);
            CAPTURE(begin);
            CHECK(run.begin == begin);
            CHECK(run.end == begin + length);
            const double expected = 0.5 * std::sqrt(length) * (1.0 - length / 100.0);
            CHECK(run.contrast == test::approx(expected));
            CHECK(run.rival == test::approx(0.0).epsilon(1e-12));
        }
    }
}

TEST_CASE("detect return: a second surface is its rival") {
    // Contrasts about the mean 0.11: (4 x 2 - 4 x 0.11) / 2 = 3.78, (3 - 0.11) / 1 = 2.89.
    std::vector<double> beam(100, 0.0);
    std::fill_n(beam.begin() + 20, 4, 2.0);
    beam[70] = 3.0;
    const DetectedReturn run = detect_return(beam);
    CHECK(run.begin == 20);
    CHECK(run.end == 24);
    CHECK(run.contrast == test::approx(3.78));
    CHECK(run.rival == test::approx(2.89));
}

TEST_CASE("detect return: nothing stands out of a level beam, or of none") {
    CHECK(detect_return({}).end == 0);
    CHECK(detect_return(std::vector<double>(50, 0.0)).end == 0);
    CHECK(detect_return(std::vector<double>(1, 3.0)).end == 0);
}

TEST_CASE("run offsets: beams of many delayed echoes have no bias after them") {
    CHECK(range_bias_m(0.0, 0.04, 300).empty());
    CHECK(range_bias_m(1e6, 0.04, 300).empty());
    CHECK(range_bias_m(11.0, 0.04, 300).size() == 301);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(1e-12, 1.0);
    constexpr double bin_m = 0.04;
    for (const double lambda_m : {0.01, 0.04, 0.12}) {
        const std::vector<double> offsets = range_bias_m(lambda_m, bin_m, 300);
        for (const double length_m : {0.0, 0.06, 0.2, 0.7}) {
            double bias = 0.0;
            constexpr int trials = 60;
            for (int trial = 0; trial < trials; ++trial) {
                // 4,000 echoes at even places, each delayed by w and faded by exp(-w / lambda).
                const double begin_m = 2.0 + bin_m * (trial + 0.5) / trials;
                std::vector<double> sum(300), count(300);
                for (int k = 0; k < 4000; ++k) {
                    const double u = unit(random);
                    const double r = begin_m + length_m * (k + 0.5) / 4000 - lambda_m * std::log(u);
                    const auto bin = static_cast<std::size_t>(r / bin_m);
                    if (bin >= sum.size()) continue;
                    sum[bin] += u;
                    ++count[bin];
                }
                for (std::size_t i = 0; i < sum.size(); ++i)
                    sum[i] = count[i] > 0.0 ? sum[i] / count[i] : 0.0;
                const DetectedReturn run = detect_return(sum);
                const auto bins = static_cast<std::size_t>(run.end - run.begin);
                bias += 0.5 * (run.begin + run.end) * bin_m - (begin_m + 0.5 * length_m) -
                        offsets[bins];
            }
            CAPTURE(lambda_m);
            CAPTURE(length_m);
            // If surfaces of several lengths make runs of one length, their offsets are
            // averaged.
            CHECK(std::fabs(bias / trials) < 0.1 * bin_m + 0.1 * lambda_m);
        }
    }
}

TEST_SUITE_END();
