#pragma once

#include <cstddef>
#include <vector>

namespace sonarsim {

/// Heights of a map, row by row; NaN: unknown.
struct HeightGrid {
    std::size_t columns = 0, rows = 0;
    std::vector<float> values;

    /// Heights between those of the grid, which stay, by cubic convolution (Keys 1981, a = -1/2:
    /// exact for parabolas): `across` - 1 between two columns, `down` - 1 between two rows. Beyond
    /// the border and an unknown height the surface continues straight. A height between two of
    /// which one is unknown is unknown.
    HeightGrid interpolated(std::size_t across, std::size_t down) const;
};

}  // namespace sonarsim
