#pragma once

#include <cstddef>
#include <vector>

#include "scene/images/georeference.h"

namespace sonarsim {

/// The most values, pixels times channels, of an image: 8,192 x 8,192 heights.
inline constexpr std::size_t most_image_values = std::size_t{1} << 26;

/// An image as it is in its file. Whole numbers have their value, not a share of the largest;
/// numbers beyond 2^24 and those of double precision are rounded to floats.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    int bits = 0;           ///< bits of one value in the file
    bool is_float = false;  ///< false: the file holds whole numbers
    /// Rows from the top, in them pixels from the left, in them channels.
    std::vector<float> values;
    Georeference reference;

    const float* pixel(int row, int column) const {
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(column);
        return &values[index * static_cast<std::size_t>(channels)];
    }
};

}  // namespace sonarsim
