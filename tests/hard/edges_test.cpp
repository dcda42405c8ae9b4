#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "paper/accumulate.h"
#include "support/approx.h"
#include "visibility/view.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

TEST_CASE("an echo that is not a number is dropped and counted") {
    Echoes echoes;
    echoes.resize(4, false);
    const float nan = std::nanf("");
    echoes.range_m = {nan, INFINITY, -1.0F, 0.5F};
    echoes.half_m = {0.1F, INFINITY, 0.1F, nan};
    echoes.weight = {1, 1, 1, 1};
    echoes.intensity = {1, 1, 1, 1};
    BinSums sums;
    sums.clear(4);
    CHECK(accumulate(echoes, {0.0F, 0.5F, 4}, sums) == 4);
    for (int i = 0; i < 4; ++i)
        CHECK(sums.weight(i) == 0.0F);
}

TEST_CASE("an echo just short of the first bin or beyond the last is dropped, one across is cut") {
    // Bins from 2 to 3 m, 0.25 m each. Truncation towards zero would put 1.8 m into the first bin.
    Echoes echoes;
    echoes.resize(5, false);
    echoes.range_m = {1.8F, 3.2F, 3.01F, 2.0F, 2.99F};
    echoes.half_m = {0.1F, 0.1F, 0.0F, 0.1F, 0.1F};
    echoes.weight = {1, 1, 1, 1, 1};
    echoes.intensity = {1, 1, 1, 1, 1};
    BinSums sums;
    sums.clear(4);
    CHECK(accumulate(echoes, {2.0F, 0.25F, 4}, sums) == 3);
    CHECK(sums.weight(0) == test::approx(0.5));  // the half of 1.9 to 2.1 m that is in range
    CHECK(sums.weight(1) == 0.0F);
    CHECK(sums.weight(2) == 0.0F);
    CHECK(sums.weight(3) == test::approx(0.55));  // the part of 2.89 to 3.09 m below 3
}

TEST_CASE("fields of view are half-open: the last edge belongs to no beam") {
    View view{radians(90.0), radians(90.0), 0.0, 10.0, 10, 3, 0.03, ViewShape::fan};
    const BeamLocator field(view);
    const auto both = [&](const Eigen::Vector3f& p) {
        const float beam = field.beam(p, p.norm());
        const int fast = beam < 0.0F ? -1 : static_cast<int>(beam);
        CHECK(fast == beam_of(view, p));
        return fast;
    };
    // 2e-5 rad to either side of the edges at 45 degrees.
    CHECK(both({1.0F, -0.99998F, 0.0F}) == 0);
    CHECK(both({1.0F, -1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.99998F, 0.0F}) == 2);
    CHECK(both({1.0F, 1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.0F, 0.99998F}) == 1);
    CHECK(both({1.0F, 0.0F, 1.00002F}) == -1);
    CHECK(both({-1.0F, 0.0F, 0.0F}) == -1);
    view.azimuth_rad = 2.0 * pi;
    // Straight behind is exactly the seam of a full turn: in the first beam or in none.
    CHECK(beam_of(view, {-1.0F, -1e-3F, 0.0F}) == 0);
    CHECK(beam_of(view, {-1.0F, 1e-3F, 0.0F}) == 2);
}

TEST_SUITE_END();
