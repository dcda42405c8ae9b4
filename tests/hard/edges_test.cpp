#include "simulate/paper/accumulate.h"
#include "support/test.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

TEST_CASE("an echo that is no number or out of range is dropped and counted, one across is cut") {
    const auto echoes_at = [](const std::vector<float>& range_m, const std::vector<float>& half_m) {
        Echoes echoes;
        echoes.resize(range_m.size(), false);
        for (std::size_t i = 0; i < range_m.size(); ++i) {
            echoes.range_m[i] = range_m[i];
            echoes.half_m[i] = half_m[i];
            echoes.weight[i] = echoes.intensity[i] = 1.0F;
        }
        return echoes;
    };
    BinSums sums;
    sums.clear(4);
    const float nan = std::nanf("");
    CHECK(accumulate(echoes_at({nan, INFINITY, -1.0F, 0.5F}, {0.1F, INFINITY, 0.1F, nan}),
                     {0.0F, 0.5F, 4}, sums) == 4);
    for (int i = 0; i < 4; ++i)
        CHECK(sums.weight(i) == 0.0F);
    // Bins from 2 to 3 m, 0.25 m each. Truncation towards zero would put 1.8 m into the first bin.
    CHECK(accumulate(echoes_at({1.8F, 3.2F, 3.01F, 2.0F, 2.99F}, {0.1F, 0.1F, 0.0F, 0.1F, 0.1F}),
                     {2.0F, 0.25F, 4}, sums) == 3);
    CHECK(sums.weight(0) == test::approx(0.5));  // the half of 1.9 to 2.1 m that is in range
    CHECK(sums.weight(1) == 0.0F);
    CHECK(sums.weight(2) == 0.0F);
    CHECK(sums.weight(3) == test::approx(0.55));  // the part of 2.89 to 3.09 m below 3
}

TEST_SUITE_END();
