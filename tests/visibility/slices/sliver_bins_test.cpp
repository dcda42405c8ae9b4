#include "visibility/slices/sliver_bins.h"

#include <doctest/doctest.h>

#include <vector>

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

/// Ten bins of 1 m from 0 to 10 m, one beam.
View ten_bins() {
    View view;
    view.range_max_m = 10.0;
    view.range_bins = 10;
    view.beams = 1;
    return view;
}

/// A surface that spans a part of the range along the boresight, of 1 m^2 per metre and
/// intensity 1.
Sample surface(float from_m, float to_m) {
    Sample sample{};
    sample.position = {0.5F * (from_m + to_m), 0.0F, 0.0F};
    sample.edge_u = {0.5F * (to_m - from_m), 0.0F, 0.0F};
    sample.edge_v = {0.0F, 1e-4F, 0.0F};
    sample.height_m = sample.position.x();
    sample.area_m2 = to_m - from_m;
    return sample;
}

double error_of(const std::vector<Sample>& items) {
    Samples samples;
    samples.items = items;
    samples.beam_begin = {0, static_cast<std::uint32_t>(items.size())};
    Material material{};
    material.reflection = 1.0F;
    return error_of_slivers(ten_bins(), {&material, 1}, samples);
}

}  // namespace

TEST_CASE("slices: bins that surface only just reaches count as errors") {
    // From bin 2 to bin 4: three bins lit, of which the last holds 0.0005, 0.002 or half a bin.
    CHECK(error_of({surface(2.5F, 4.0005F)}) == doctest::Approx(0.7 / 3.0).epsilon(1e-3));
    CHECK(error_of({surface(2.5F, 4.002F)}) == doctest::Approx(0.3 / 3.0).epsilon(1e-3));
    CHECK(error_of({surface(2.5F, 4.5F)}) == 0.0);
    // What ends just before the border: two bins are lit.
    CHECK(error_of({surface(2.5F, 3.9995F)}) == doctest::Approx(0.6 / 2.0).epsilon(1e-3));
    // Nothing hangs on a sliver in a bin that another surface fills.
    CHECK(error_of({surface(2.5F, 4.0005F), surface(4.2F, 4.9F)}) == 0.0);
    CHECK(error_of({}) == 0.0);
}
