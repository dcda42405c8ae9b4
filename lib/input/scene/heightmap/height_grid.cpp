#include "input/scene/heightmap/height_grid.h"

#include <cmath>

namespace sonarsim {

namespace {

/// The value at `t` between the second and the third of four neighbours.
float cubic(float before, float first, float second, float after, float t) {
    if (std::isnan(before)) before = 2.0F * first - second;
    if (std::isnan(after)) after = 2.0F * second - first;
    const float a = 2.0F * before - 5.0F * first + 4.0F * second - after;
    const float b = 3.0F * (first - second) + after - before;
    return first + 0.5F * t * (second - before + t * (a + t * b));
}

/// A grid with `parts` - 1 rows more between two rows.
HeightGrid with_rows(const HeightGrid& grid, std::size_t parts) {
    HeightGrid out{grid.columns, (grid.rows - 1) * parts + 1, {}};
    out.values.reserve(out.columns * out.rows);
    const auto at = [&](std::size_t row, std::size_t column) {
        return row < grid.rows ? grid.values[row * grid.columns + column] : std::nanf("");
    };
    for (std::size_t k = 0; k < out.rows; ++k) {
        const std::size_t row = k / parts;
        const float t = static_cast<float>(k % parts) / static_cast<float>(parts);
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const float first = at(row, column);
            // Row -1 wraps around to a number beyond the last.
            out.values.push_back(t == 0.0F ? first
                                           : cubic(at(row - 1, column), first, at(row + 1, column),
                                                   at(row + 2, column), t));
        }
    }
    return out;
}

HeightGrid transposed(const HeightGrid& grid) {
    HeightGrid out{grid.rows, grid.columns, {}};
    out.values.reserve(grid.values.size());
    for (std::size_t column = 0; column < grid.columns; ++column) {
        for (std::size_t row = 0; row < grid.rows; ++row)
            out.values.push_back(grid.values[row * grid.columns + column]);
    }
    return out;
}

}  // namespace

HeightGrid HeightGrid::interpolated(std::size_t across, std::size_t down) const {
    const HeightGrid tall = down == 1 ? *this : with_rows(*this, down);
    return across == 1 ? tall : transposed(with_rows(transposed(tall), across));
}

}  // namespace sonarsim
