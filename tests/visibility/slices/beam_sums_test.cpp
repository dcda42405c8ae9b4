#include "visibility/slices/beam_sums.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/approx.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

View view_of(int bins) {
    View view;
    view.range_min_m = 1.0;
    view.range_max_m = 21.0;
    view.range_bins = bins;
    return view;
}

double total_area(const BeamSums& sums) {
    double area = 0.0;
    for (int i = 0; i < sums.count(); ++i)
        area += static_cast<double>(sums.area(i));
    return area;
}

}  // namespace

TEST_CASE("slices: surface of one range keeps its area in far bins") {
    // The depth of such surface is below one step of a float.
    BeamSums sums(view_of(8192));
    sums.add({20.3F, 20.3F}, 0.5F, 20.0F, 1.0F);
    CHECK(total_area(sums) == test::approx(0.5).epsilon(0.1));
    CHECK(std::isfinite(sums.echo(sums.first())));
}

TEST_CASE("slices: bins share the area of surface by its overlap, within the view alone") {
    constexpr int bins = 50;
    const double bin_m = 20.0 / bins;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> range(0.0, 24.0);
    std::uniform_real_distribution<double> depth(0.0, 9.0);
    for (int run = 0; run < 200; ++run) {
        const double from = range(random);
        const double to = from + depth(random);
        BeamSums sums(view_of(bins));
        sums.add({static_cast<float>(from), static_cast<float>(to)}, 2.0F, 1.0F, 1.0F);
        for (int i = -1; i < bins + BeamSums::padding; ++i) {
            const double low = std::max(1.0 + i * bin_m, from);
            const double high = std::min(1.0 + (i + 1) * bin_m, to);
            const bool in_view = i >= 0 && i < bins;
            const double expected = in_view ? 2.0 * std::max(high - low, 0.0) / (to - from) : 0.0;
            CHECK(static_cast<double>(sums.area(i)) ==
                  test::approx(expected).epsilon(1e-3).scale(0.1));
        }
        sums.clear();
        CHECK(total_area(sums) == 0.0);
    }
}

TEST_SUITE_END();
