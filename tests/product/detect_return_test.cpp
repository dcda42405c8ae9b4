#include "simulate/product/soundings.h"
#include "support/test.h"

TEST_CASE("detect return: a bright stretch of any place and length is found exactly") {
    // A run that is one bin longer or shorter than a stretch of n bins of brightness b over m bins
    // of 0 in all has the contrast b n (1 - n / m) / sqrt(n) times sqrt(n / (n + 1)), or times
    // sqrt((n - 1) / n) and less: the stretch itself is the best.
    for (const int length : {1, 2, 3, 5, 9, 17, 40}) {
        for (int begin = 0; begin + length <= 100; begin += 7) {
            std::vector<double> beam(100, 0.25);
            std::fill_n(beam.begin() + begin, length, 0.75);
            const DetectedReturn run = detect_return(beam);
            CAPTURE_ALL(length, begin);
            CHECK(run.begin == begin);
            CHECK(run.end == begin + length);
            CHECK(run.contrast == approx(0.5 * std::sqrt(length) * (1.0 - length / 100.0)));
            CHECK(run.rival == approx(0.0).epsilon(1e-12));
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
    CHECK(run.contrast == approx(3.78));
    CHECK(run.rival == approx(2.89));
}

TEST_CASE("detect return: nothing stands out of a level beam, or of none") {
    CHECK(detect_return({}).end == 0);
    CHECK(detect_return(std::vector<double>(50, 0.0)).end == 0);
    CHECK(detect_return(std::vector<double>(1, 3.0)).end == 0);
}
