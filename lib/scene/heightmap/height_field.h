#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/images/image_place.h"
#include "scene/placed_file.h"

namespace sonarsim {

/// The most heights of a map: with two triangles each, a scene then takes about 12 GB.
inline constexpr std::size_t most_heights = std::size_t{1} << 25;

/// The heights of a map, or of the part that a mission needs.
struct HeightField {
    PixelGrid grid;
    PixelWindow window;
    std::vector<float> heights;  ///< values of the pixels of the window, row after row
    std::vector<bool> known;     ///< false for those without a height

    std::size_t index(int row, int column) const {
        return static_cast<std::size_t>(row - window.first_row) * window.width() +
               static_cast<std::size_t>(column - window.first_column);
    }
};

/// Reads an image of heights. InputError as ImageReader::read(), for an image of several channels,
/// one whose place is not known or in degrees, and for values that are no heights.
HeightField read_heights(const std::filesystem::path& path, const HeightmapRule& rule,
                         ImageReader& images);

}  // namespace sonarsim
