#include "support/slivers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "support/approx.h"
#include "support/shapes.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("lattices");

TEST_CASE("slivers: a reference gets surface that its rays missed, and no other") {
    // Ten bins of 1 m, one beam of 20 degrees. A plate across the boresight, 5 m away and 1 m wide,
    // reaches from 5 m to sqrt(5^2 + 0.5^2) = 5.02 m. A second one behind it is hidden, and a third
    // reaches the bin from 8 m on with its corners, by 3e-5 of a bin.
    View view;
    view.azimuth_rad = view.elevation_rad = radians(20.0);
    view.range_max_m = 10.0;
    view.range_bins = 10;
    view.beams = 1;
    Scene scene = shapes::empty_scene();
    const std::uint32_t material = shapes::add_material(scene, 0.5F);
    const auto plate = [&](float x, float half, float y) {
        shapes::add_quad(scene, {x, y - half, -half}, {x, y + half, -half}, {x, y + half, half},
                         {x, y - half, half}, material);
    };
    plate(5.0F, 0.5F, 0.0F);
    plate(6.5F, 0.1F, 0.0F);
    const auto corner = static_cast<float>(std::sqrt(8.00003 * 8.00003 - 1.3 * 1.3 - 0.01));
    plate(corner, 0.1F, 1.2F);
    Reference reference{10, 1, std::vector<float>(10, 0.0F)};
    const std::vector<float> image(10, 1.0F);
    test::add_slivers(scene, view, image, reference);
    CHECK(reference.intensity[5] == test::approx(0.5).epsilon(0.005));
    CHECK(reference.intensity[6] == 0.0F);
    CHECK(reference.intensity[8] == test::approx(0.5 * corner / 8.0).epsilon(0.001));
    CHECK(reference.intensity[9] == 0.0F);
    // Nothing is looked for in dark bins of the image, and what is known stays.
    Reference known{10, 1, std::vector<float>(10, 0.0F)};
    known.intensity[5] = 0.25F;
    test::add_slivers(scene, view, std::vector<float>(10, 0.0F), known);
    CHECK(known.intensity[5] == 0.25F);
    CHECK(known.intensity[8] == 0.0F);
}

TEST_SUITE_END();
