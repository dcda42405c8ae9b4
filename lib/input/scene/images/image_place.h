#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "input/scene/images/image.h"

namespace sonarsim {

/// Reads the world file next to an image, map.tfw, map.tifw or map.wld for map.tif; nullopt if
/// there is none. InputError if it has not six numbers, or for a grid that is turned.
std::optional<PixelGrid> read_world_file(const std::filesystem::path& image);

/// The pixels of an image in the coordinates of its map, m. If `pixel_m`, the size of a pixel, is
/// above 0, the south-west corner is (0, 0); else the file places the pixels. InputError if the
/// file has no place for them, or one in degrees; `section` is the mission's section of pixel_m.
PixelGrid grid_in_metres(const Image& image, double pixel_m, const std::string& section,
                         const Location& where);

/// Rows and columns of an image, from the first to before the last.
struct PixelWindow {
    std::array<int, 2> rows{};
    std::array<int, 2> columns{};

    std::size_t width() const { return static_cast<std::size_t>(columns[1] - columns[0]); }
    std::size_t height() const { return static_cast<std::size_t>(rows[1] - rows[0]); }

    /// Calls use(row, column) for every pixel, row by row.
    template <class Use>
    void for_each(const Use& use) const {
        for (int row = rows[0]; row < rows[1]; ++row) {
            for (int column = columns[0]; column < columns[1]; ++column)
                use(row, column);
        }
    }
};

/// The pixels in a box of the map's coordinates, with a margin; all rows, or all columns, if fewer
/// than two would remain. InputError for more pixels than `most`.
PixelWindow pixels_within(const Image& image, const PixelGrid& grid,
                          const Eigen::AlignedBox2d& box_m, std::size_t most,
                          const Location& where);

}  // namespace sonarsim
