#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace sonarsim {

/// The most values, pixels times channels, of an image: 8,192 x 8,192 heights.
inline constexpr std::size_t max_image_values = std::size_t{1} << 26;
/// The most values of a row, of which OpenImageIO reserves 64.
inline constexpr std::size_t max_row_values = std::size_t{1} << 22;

/// The pixels of an image in the coordinates of its map: the centre of the pixel in row r
/// and column c lies at (x_m + c * column_m, y_m + r * row_m).
struct PixelGrid {
    double x_m = 0.0;  ///< x of the centre of the first pixel of the first row
    double y_m = 0.0;
    double column_m = 1.0;  ///< from one column to the next; towards the east
    double row_m = -1.0;    ///< from one row to the next; negative: the first row is the north
};

/// An image as it is in its file. Whole numbers have their value, not a share of the largest;
/// numbers beyond 2^24 and those of double precision are rounded to floats.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    int bits = 0;           ///< bits of one value in the file
    bool is_float = false;  ///< false: the file holds whole numbers
    /// Rows from the top, in them pixels from the left, in them channels. NaN: no value.
    std::vector<float> values;
    std::optional<PixelGrid> grid;  ///< the place on its map, as the file has it
    bool in_degrees = false;        ///< `grid` has longitudes and latitudes, not metres
    bool has_no_data = false;       ///< the file names the value of pixels without one

    /// The channels without that of transparency.
    int colours() const { return channels % 2 == 0 ? channels - 1 : channels; }

    const float* pixel(int row, int column) const {
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(column);
        return &values[index * static_cast<std::size_t>(channels)];
    }
};

}  // namespace sonarsim
