#include "input/scene/heightmap/height_model.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/images/read_image.h"
#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

/// The most heights of a map: with two triangles each, a scene then takes about 12 GB.
constexpr std::size_t max_heights = std::size_t{1} << 25;

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

/// The two triangles of every four neighbours whose heights are known. Counter-clockwise as seen
/// from above where rows run to the south and columns to the east.
std::vector<std::uint32_t> corners_of_cells(const HeightGrid& heights, bool mirrored) {
    const auto width = static_cast<std::uint32_t>(heights.columns);
    const auto height = static_cast<std::uint32_t>(heights.rows);
    const auto known = [&](std::uint32_t k) { return !std::isnan(heights.values[k]); };
    std::vector<std::uint32_t> corners;
    corners.reserve(6 * (heights.columns - 1) * (heights.rows - 1));
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (!known(a) || !known(b) || !known(c)) return;
        if (mirrored) std::swap(b, c);
        corners.insert(corners.end(), {a, b, c});
    };
    for (std::uint32_t row = 0; row + 1 < height; ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t north_west = row * width + column;
            const std::uint32_t south_west = north_west + width;
            if (known(north_west) && known(south_west + 1)) {
                add(north_west, south_west, south_west + 1);
                add(north_west, south_west + 1, north_west + 1);
            } else {  // the other diagonal may make a triangle
                add(north_west, south_west, north_west + 1);
                add(north_west + 1, south_west, south_west + 1);
            }
        }
    }
    return corners;
}

/// The parts of a pixel's side that are at most `cell_m` long; 0: the pixel is one part.
std::size_t parts_of_cell(double pixel_m, double cell_m) {
    constexpr double rounding = 1e-9;
    if (cell_m == 0.0) return 1;
    const double parts = std::ceil(std::fabs(pixel_m) / cell_m - rounding);
    return static_cast<std::size_t>(std::clamp(parts, 1.0, static_cast<double>(max_heights)));
}

void require_room(const HeightGrid& heights, std::size_t across, std::size_t down,
                  const Location& where) {
    const double columns = static_cast<double>(heights.columns) * static_cast<double>(across);
    const double rows = static_cast<double>(heights.rows) * static_cast<double>(down);
    if (columns * rows <= static_cast<double>(max_heights)) return;
    refuse(where,
           "scene.heightmap.cell_m makes {:.0f} x {:.0f} heights of it, and at most {} have room; "
           "make cell_m longer",
           columns, rows, max_heights);
}

void require_heights(const Image& image, const Location& where) {
    if (image.channels != 1) {
        refuse(
            where,
            "has {} channels, and a heightmap has one: take one out, as with gdal_translate -b 1",
            image.channels);
    }
    if (image.width < 2 || image.height < 2)
        refuse(where, "has {} x {} pixels, and a surface needs 2 x 2", image.width, image.height);
}

/// True for a number that looks like the mark of an unknown height.
bool is_odd(float value, const Image& image) {
    constexpr std::array<float, 5> usual_marks{-9999.0F, -99999.0F, -32767.0F, -32768.0F,
                                               -2147483648.0F};
    constexpr float largest = 1e30F;
    return !(std::fabs(value) <= largest) || (!image.has_no_data && contains(usual_marks, value));
}

}  // namespace

HeightGrid HeightGrid::interpolated(std::size_t across, std::size_t down) const {
    const HeightGrid tall = down == 1 ? *this : with_rows(*this, down);
    return across == 1 ? tall : transposed(with_rows(transposed(tall), across));
}

tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule) {
    const Location where{path.string()};
    const Image image = read_image(path);
    require_heights(image, where);
    if (image.heights_in_feet && !rule.is_scaled)
        refuse(where,
               "has its heights in feet; write scene.heightmap.height_scale: 0.3048, or of depths "
               "-0.3048");
    const PixelGrid grid = grid_in_metres(image, rule.pixel_m, "scene.heightmap", where);
    const PixelWindow window = pixels_within(image, grid,
                                             {Eigen::Vector2d(rule.window[0], rule.window[1]),
                                              Eigen::Vector2d(rule.window[2], rule.window[3])},
                                             max_heights, where);
    HeightGrid heights{window.width(), window.height(), {}};
    heights.values.reserve(heights.columns * heights.rows);
    window.for_each([&](int row, int column) {
        const float value = *image.pixel(row, column);
        if (!std::isnan(value) && is_odd(value, image)) {
            refuse(where,
                   "row {0}, column {1}: {2} looks like the mark of an unknown height; mark it in "
                   "the file: gdal_translate -a_nodata {2}",
                   row, column, number_text(double{value}));
        }
        heights.values.push_back(value);
    });
    const std::size_t across = parts_of_cell(grid.column_m, rule.cell_m);
    const std::size_t down = parts_of_cell(grid.row_m, rule.cell_m);
    require_room(heights, across, down, where);
    heights = heights.interpolated(across, down);
    const std::vector<float> positions = grid_positions(
        heights.values, heights.columns, Eigen::Array2f(window.columns[0], window.rows[0]),
        Eigen::Array2f(across, down));
    const std::vector<std::uint32_t> corners =
        corners_of_cells(heights, grid.column_m * grid.row_m > 0.0);
    if (corners.empty()) refuse(where, "has no three neighbours with known heights");
    tinygltf::Model model;
    const int mesh = add_mesh(model, "heightmap");
    add_triangles(model, mesh, add_positions(model, positions), corners, -1);
    add_node(model, "heightmap", mesh).matrix =
        grid_matrix(grid.column_m, grid.row_m, grid.x_m, grid.y_m);
    return model;
}

}  // namespace sonarsim
