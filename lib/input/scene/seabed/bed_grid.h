#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/random.h"

namespace sonarsim {

/// A part of the endless grid of a bed's heights. Cells are counted from the bed's (0, 0), to the
/// east and to the north; the height of a cell stands at its centre. The part begins with its
/// northern row, as an image does.
struct BedGrid {
    double cell_m = 1.0;
    std::int64_t west = 0;   ///< number of the first column
    std::int64_t north = 0;  ///< number of the first row, the largest
    int columns = 0;
    int rows = 0;

    std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    /// The centres of a column and of a row, in metres of the bed.
    double x_m(int column) const { return (static_cast<double>(west + column) + 0.5) * cell_m; }
    double y_m(int row) const { return (static_cast<double>(north - row) + 0.5) * cell_m; }
};

/// A part of a bed: least x and y, largest x and y, m.
using BedArea = std::array<double, 4>;

/// The subjects of the draws for a bed. Draws of different subjects are independent.
enum class BedDraw : std::uint32_t {
    roughness = 1,  ///< the octave as `number`
    ripples = 2,
    sediments = 6,  ///< the octave as `number`
    rocks = 10,
    rock_shapes = 11,
};

inline PhiloxKey bed_key(std::uint64_t seed, BedDraw subject, std::uint32_t number = 0) {
    return stream_key(seed, static_cast<std::uint32_t>(subject), number, stream_named("seabed"));
}

}  // namespace sonarsim
