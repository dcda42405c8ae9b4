#include "input/scene/heightmap/height_model.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/images/image_place.h"
#include "input/scene/images/read_image.h"
#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

/// The most heights of a map: with two triangles each, a scene then takes about 12 GB.
constexpr std::size_t max_heights = std::size_t{1} << 25;

/// The two triangles of every four neighbours whose heights are known. Counter-clockwise as seen
/// from above where rows run to the south and columns to the east.
std::vector<std::uint32_t> corners_of_cells(std::size_t width, const std::vector<bool>& known,
                                            bool mirrored) {
    const std::size_t height = known.size() / width;
    std::vector<std::uint32_t> corners;
    corners.reserve(6 * (width - 1) * (height - 1));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        if (!known[a] || !known[b] || !known[c]) return;
        if (mirrored) std::swap(b, c);
        for (const std::size_t corner : {a, b, c})
            corners.push_back(static_cast<std::uint32_t>(corner));
    };
    for (std::size_t row = 0; row + 1 < height; ++row) {
        for (std::size_t column = 0; column + 1 < width; ++column) {
            const std::size_t north_west = row * width + column;
            const std::size_t south_west = north_west + width;
            if (known[north_west] && known[south_west + 1]) {
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

void require_heights(const Image& image, const Location& where) {
    if (image.channels != 1) {
        throw InputError(where, "has " + std::to_string(image.channels) +
                                    " channels, and a heightmap has one: take one out, as with "
                                    "gdal_translate -b 1");
    }
    if (image.width < 2 || image.height < 2) {
        throw InputError(where, "has " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) +
                                    " pixels, and a surface needs 2 x 2");
    }
}

/// True for a number that looks like the mark of an unknown height.
bool is_odd(float value, const Image& image) {
    constexpr std::array<float, 5> usual_marks{-9999.0F, -99999.0F, -32767.0F, -32768.0F,
                                               -2147483648.0F};
    constexpr float largest = 1e30F;
    return !(std::fabs(value) <= largest) ||
           (!image.has_no_data && std::ranges::find(usual_marks, value) != usual_marks.end());
}

}  // namespace

tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule) {
    const Location where{path.string()};
    const Image image = read_image(path);
    require_heights(image, where);
    const PixelGrid grid = grid_in_metres(image, rule.pixel_m, "scene.heightmap", where);
    const PixelWindow window = pixels_within(image, grid,
                                             {Eigen::Vector2d(rule.window[0], rule.window[1]),
                                              Eigen::Vector2d(rule.window[2], rule.window[3])},
                                             max_heights, where);
    std::vector<float> positions;
    std::vector<bool> known;
    positions.reserve(3 * window.width() * window.height());
    known.reserve(window.width() * window.height());
    window.for_each([&](int row, int column) {
        const float value = *image.pixel(row, column);
        known.push_back(!std::isnan(value));
        if (known.back() && is_odd(value, image)) {
            throw InputError(
                where,
                fmt::format("row {}, column {}: {} looks like the mark of an unknown "
                            "height; mark it in the file: gdal_translate -a_nodata {}",
                            row, column, number_text(double{value}), number_text(double{value})));
        }
        for (const float x : {static_cast<float>(column), static_cast<float>(row), value})
            positions.push_back(x);
    });
    const std::vector<std::uint32_t> corners =
        corners_of_cells(window.width(), known, grid.column_m * grid.row_m > 0.0);
    if (corners.empty()) throw InputError(where, "has no three neighbours with known heights");
    tinygltf::Model model;
    const int mesh = add_mesh(model, "heightmap");
    add_triangles(model, mesh, add_positions(model, positions), corners, -1);
    add_node(model, "heightmap", mesh).matrix =
        grid_matrix(grid.column_m, grid.row_m, grid.x_m, grid.y_m);
    return model;
}

}  // namespace sonarsim
