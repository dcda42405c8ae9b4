#include "scene/heightmap/height_model.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/images/image_place.h"
#include "scene/images/read_image.h"
#include "scene/images/unknown_pixels.h"
#include "scene/model_data.h"

namespace sonarsim {

namespace {

/// The most heights of a map: with two triangles each, a scene then takes about 12 GB.
constexpr std::size_t most_heights = std::size_t{1} << 25;

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
        corners.push_back(static_cast<std::uint32_t>(a));
        corners.push_back(static_cast<std::uint32_t>(b));
        corners.push_back(static_cast<std::uint32_t>(c));
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

/// InputError for a value that is not a height. `no_data`: the mark of unknown heights, if one is
/// known.
void require_height(float value, const std::optional<double>& no_data, int row, int column,
                    const Location& where) {
    constexpr std::array<float, 5> usual_marks{-9999.0F, -99999.0F, -32767.0F, -32768.0F,
                                               -2147483648.0F};
    bool is_odd = !(std::fabs(value) <= huge_pixel);
    for (const float mark : usual_marks)
        is_odd = is_odd || (!no_data && value == mark);
    if (!is_odd) return;
    const std::string text = number_text(static_cast<double>(value));
    throw InputError(where,
                     fmt::format("row {}, column {}: {} looks like the mark of an unknown height; "
                                 "write scene.heightmap.no_data: {}, or another number that does "
                                 "not occur if it is a height",
                                 row, column, text, std::isfinite(value) ? text : "3.4e38"));
}

PixelWindow window_of(const Image& image, const PixelGrid& grid, const HeightmapRule& rule,
                      const Location& where) {
    PixelWindow window{0, image.height, 0, image.width};
    if (rule.window) {
        const auto& w = *rule.window;
        window =
            pixels_within(image, grid, {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])});
    }
    if (window.width() * window.height() <= most_heights) return window;
    throw InputError(where, fmt::format("the mission needs {} x {} heights of it, and at most 2^25 "
                                        "have room; make it coarser with gdal_translate -outsize "
                                        "50% 50%, or cut a part out with gdal_translate -projwin",
                                        window.width(), window.height()));
}

/// The heights of a map, or of the part that a mission needs.
struct HeightVertices {
    PixelGrid grid;
    std::vector<float> positions;  ///< column, row and value of each
    std::vector<bool> known;       ///< false for those without a height
    std::size_t width = 0;         ///< vertices of a row
};

HeightVertices read_heights(const std::filesystem::path& path, const HeightmapRule& rule,
                            const Location& where) {
    const Image image = read_image(path);
    require_heights(image, where);
    HeightVertices out;
    out.grid = grid_in_metres(image, rule.pixel_m, rule.size_m, "scene.heightmap", where);
    std::optional<double> no_data = rule.no_data ? rule.no_data : image.no_data;
    if (no_data && std::isnan(*no_data)) no_data.reset();  // NaN is not a height anyway
    const PixelWindow window = window_of(image, out.grid, rule, where);
    const UnknownPixels unknown(no_data);
    out.width = window.width();
    out.positions.reserve(3 * window.width() * window.height());
    out.known.reserve(window.width() * window.height());
    for (int row = window.first_row; row < window.last_row; ++row) {
        for (int column = window.first_column; column < window.last_column; ++column) {
            const float value = *image.pixel(row, column);
            const bool is_known = !unknown.has(value);
            if (is_known) require_height(value, no_data, row, column, where);
            out.known.push_back(is_known);
            for (const float x : {static_cast<float>(column), static_cast<float>(row), value})
                out.positions.push_back(x);
        }
    }
    return out;
}

void add_height_node(tinygltf::Model& model, const PixelGrid& grid, int positions, int corners) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = corners;
    tinygltf::Mesh mesh;
    mesh.name = "heightmap";
    mesh.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = "heightmap";
    node.mesh = 0;
    node.matrix = {grid.column_m, 0.0,        0.0, 0.0,  //
                   0.0,           grid.row_m, 0.0, 0.0,  //
                   0.0,           0.0,        1.0, 0.0,  //
                   grid.x_m,      grid.y_m,   0.0, 1.0};
    model.nodes.push_back(std::move(node));
}

}  // namespace

tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule) {
    const Location where{path.string()};
    const HeightVertices vertices = read_heights(path, rule, where);
    const PixelGrid& grid = vertices.grid;
    const std::vector<std::uint32_t> corners =
        corners_of_cells(vertices.width, vertices.known, grid.column_m * grid.row_m > 0.0);
    if (corners.empty())
        throw InputError(where, "has no three neighbours with known heights; check no_data");
    tinygltf::Model model;
    const int positions = add_accessor(model, vertices.positions, vertices.known.size(),
                                       TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    const int indices = add_accessor(model, corners, corners.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    add_height_node(model, grid, positions, indices);
    return model;
}

}  // namespace sonarsim
