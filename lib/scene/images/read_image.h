#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
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

/// True if the file begins like a PNG, TIFF or OpenEXR image.
bool is_image_file(const std::filesystem::path& path);

/// Reads a PNG, TIFF (GeoTIFF, BigTIFF) or OpenEXR image; its content says which. OpenImageIO does
/// it in a child process, since damaged files make such libraries crash, and since it takes 0.2 s
/// and threads to load. It reads the first of several images in a file. InputError for a file
/// that is damaged, has another format or more values than `most_image_values`, and without
/// OpenImageIO.
Image read_image(const std::filesystem::path& path);

/// The same for the bytes of a file, which have no place. `where` names them.
Image read_image(std::string_view bytes, const Location& where);

}  // namespace sonarsim
