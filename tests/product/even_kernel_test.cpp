#include "product/even_kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/approx.h"

using namespace sonarsim;

namespace {

struct Moments {
    double sum = 0.0;
    double centroid = 0.0;  ///< bins from the middle of the pixel's bin
    double squares = 0.0;
    double least = 0.0;
};

Moments moments(const KernelTable& table, int phase) {
    Moments m;
    for (int k = 0; k < table.taps; ++k) {
        const double weight = table.weights[static_cast<std::size_t>(phase) * table.taps + k];
        m.sum += weight;
        m.centroid += weight * (table.first[phase] + k);
        m.squares += weight * weight;
        m.least = std::min(m.least, weight);
    }
    return m;
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("even kernel: whatever the place, the same noise, the right centroid, no lobes") {
        // Weights are rounded to 1/256, so to half of that; in the sum of squares twice the weight.
        for (const double extent : {0.1, 1.0, 1.3, 2.0, 3.7, 20.0}) {
            const KernelTable table = make_kernel(extent, 4);
            CHECK(table.taps % 4 == 0);
            double low = 1.0;
            double high = 0.0;
            for (int phase = 0; phase < KernelTable::phases; ++phase) {
                const Moments m = moments(table, phase);
                CAPTURE(extent);
                CAPTURE(phase);
                REQUIRE(m.sum == 1.0);
                REQUIRE(m.least == 0.0);
                const double centre = (phase + 0.5) / KernelTable::phases - 0.5;
                REQUIRE(std::fabs(m.centroid - centre) < 0.02);
                low = std::min(low, m.squares);
                high = std::max(high, m.squares);
            }
            CHECK(high / low < 1.05);
            if (extent <= 1.0) CHECK(high == test::approx(0.5).epsilon(0.02));
            if (extent > 4.0) CHECK(high == test::approx(1.0 / extent).epsilon(0.1));
        }
    }

    TEST_CASE("even kernel: places are found by bin and phase") {
        CHECK(kernel_place(0.0).bin == 0);
        CHECK(kernel_place(0.0).phase == 0);
        CHECK(kernel_place(7.5).bin == 7);
        CHECK(kernel_place(7.5).phase == KernelTable::phases / 2);
        CHECK(kernel_place(7.999999).phase == KernelTable::phases - 1);
    }
}
