#include "preview/fan_style.h"

#include <doctest/doctest.h>

#include "product/colour_map.h"

using namespace sonarsim;

TEST_SUITE("preview") {
    TEST_CASE("colours: brightness grows with the value") {
        // Rec. 709 luminance.
        const auto luminance = [](const Rgb& c) {
            return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        };
        for (const std::span<const Rgb> stops :
             {std::span<const Rgb>(copper_colours), std::span<const Rgb>(amber_colours),
              std::span<const Rgb>(sea_colours)}) {
            for (std::size_t k = 1; k < stops.size(); ++k)
                CHECK(luminance(stops[k]) > luminance(stops[k - 1]));
            CHECK(luminance(stops.back()) - luminance(stops.front()) > 150.0);
        }
    }
}
