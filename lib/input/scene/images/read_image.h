#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

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
    enum class Unit { metre, degree, unnamed } unit = Unit::metre;  ///< for `grid`
    bool heights_in_feet = false;                                   ///< the file says so
    bool has_no_data = false;  ///< the file names the value of pixels without one

    /// The channels without that of transparency.
    int colours() const { return channels % 2 == 0 ? channels - 1 : channels; }

    const float* pixel(int row, int column) const {
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(column);
        return &values[index * static_cast<std::size_t>(channels)];
    }
};

/// True if the file begins like a PNG, TIFF or OpenEXR image.
bool is_image_file(const std::filesystem::path& path);

/// Reads a PNG, TIFF (GeoTIFF, BigTIFF) or OpenEXR image through OpenImageIO; its content says
/// which. Reads the first of several images in a file. Its place on the map is that of its GeoTIFF
/// tags, else that of a world file next to it. InputError for a file that is damaged, has another
/// format or more values than `max_image_values` or `max_row_values`, or that OpenImageIO would
/// read wrongly, and without OpenImageIO.
Image read_image(const std::filesystem::path& path);

/// The EPSG code of a GeoTIFF's projected reference system; 0: none. InputError as above.
int epsg_of(const std::filesystem::path& path);

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
    void for_each(const auto& use) const {
        for (int row = rows[0]; row < rows[1]; ++row) {
            for (int column = columns[0]; column < columns[1]; ++column)
                use(row, column);
        }
    }
};

/// The pixels in a box of the map's coordinates, with a margin; all rows, or all columns, if fewer
/// than two would remain. InputError for more pixels than `most`.
PixelWindow pixels_within(const Image& image, const PixelGrid& grid,
                          const Eigen::AlignedBox2d& box_m, std::size_t max_pixels,
                          const Location& where);

}  // namespace sonarsim
