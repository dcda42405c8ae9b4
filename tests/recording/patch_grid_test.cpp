#include "recording/patch_grid.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/random.h"

using namespace sonarsim;

TEST_SUITE("recording") {
    TEST_CASE("patch grid: drawn grids hold each bin once, at its place") {
        for (std::uint32_t draw = 0; draw < 30; ++draw) {
            const PhiloxBlock drawn = philox({draw, 0, 0, 0}, {31, 0});
            const int ranges = 1 + static_cast<int>(drawn.x0 % 40);
            const int beams = 1 + static_cast<int>(drawn.x1 % 40);
            const PatchGrid grid(
                {1 + static_cast<int>(drawn.x2 % 12), 1 + static_cast<int>(drawn.x3 % 12)}, ranges,
                beams);
            std::vector<float> values;
            for (int k = 0; k < ranges * beams; ++k)
                values.push_back(static_cast<float>(k));
            std::vector<int> visits(values.size());
            for (int place = 0; place < grid.places(); ++place) {
                grid.for_each_bin({values, ranges, beams}, place, [&](float value, int i, int j) {
                    CHECK(value == static_cast<float>(i * beams + j));
                    CHECK(grid.place_of(i, j) == place);
                    ++visits[static_cast<std::size_t>(i * beams + j)];
                });
            }
            for (int k = 0; k < ranges * beams; ++k) {
                const bool is_in = k / beams < grid.rows * grid.size.ranges &&
                                   k % beams < grid.columns * grid.size.beams;
                CHECK(visits[static_cast<std::size_t>(k)] == (is_in ? 1 : 0));
            }
        }
    }
}
