#include "scene/heightmap/height_model.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scene/images/read_image.h"
#include "scene/model_data.h"

namespace sonarsim {

namespace {

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

/// The pixels in the coordinates of the map.
PixelGrid grid_of(const Image& image, const HeightmapRule& rule, const Location& where) {
    std::array<double, 2> pixel{rule.pixel_m, rule.pixel_m};
    if (rule.size_m[0] > 0.0) pixel = {rule.size_m[0] / image.width, rule.size_m[1] / image.height};
    if (pixel[0] > 0.0)
        return {0.5 * pixel[0], (image.height - 0.5) * pixel[1], pixel[0], -pixel[1]};
    if (!image.reference.grid) {
        throw InputError(where,
                         "does not say how large its pixels are: it has no GeoTIFF tags, "
                         "and no world file lies beside it; write "
                         "scene.heightmap.pixel_m or size_m");
    }
    if (image.reference.in_degrees) {
        throw InputError(where,
                         "has its pixels in degrees; make a map in metres of it, as with "
                         "gdalwarp -t_srs EPSG:32632");
    }
    return *image.reference.grid;
}

/// Finds the pixels that have no height. The largest numbers, which mark them in many files, are
/// written with few digits there.
class UnknownHeights {
  public:
    /// NaN is no height anyway.
    explicit UnknownHeights(std::optional<double> no_data) {
        if (!no_data || std::isnan(*no_data)) return;
        no_data_ = no_data;
        as_float_ = static_cast<float>(*no_data);
    }

    bool has(float value) const {
        if (std::isnan(value)) return true;
        if (!no_data_) return false;
        if (value == as_float_) return true;
        return std::fabs(*no_data_) > huge && std::fabs(value) > huge &&
               (value < 0.0F) == (*no_data_ < 0.0);
    }

    /// InputError for a value that is no height.
    void require_height(float value, int row, int column, const Location& where) const {
        constexpr std::array<float, 5> usual_marks{-9999.0F, -99999.0F, -32767.0F, -32768.0F,
                                                   -2147483648.0F};
        bool is_odd = !(std::fabs(value) <= huge);
        for (const float mark : usual_marks)
            is_odd = is_odd || (!no_data_ && value == mark);
        if (!is_odd) return;
        const std::string text = number_text(static_cast<double>(value));
        throw InputError(
            where, fmt::format("row {}, column {}: {} looks like the mark of an unknown height; "
                               "write scene.heightmap.no_data: {}, or another number that does not "
                               "occur if it is a height",
                               row, column, text, std::isfinite(value) ? text : "3.4e38"));
    }

  private:
    static constexpr double huge = 1e30;

    std::optional<double> no_data_;
    float as_float_ = 0.0F;
};

/// Rows and columns of the image, from the first to before the last.
struct PixelWindow {
    int first_row = 0;
    int last_row = 0;
    int first_column = 0;
    int last_column = 0;

    std::size_t width() const { return static_cast<std::size_t>(last_column - first_column); }
    std::size_t height() const { return static_cast<std::size_t>(last_row - first_row); }
};

/// The pixels from `low` to `high`, with a margin, of `count` that begin at `start`; all if there
/// are none.
std::array<int, 2> pixels_within(double low, double high, double start, double step, int count) {
    constexpr double margin = 2.0;
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    const double first = std::max(std::floor(std::min(a, b)) - margin, 0.0);
    const double last = std::min(std::ceil(std::max(a, b)) + margin, static_cast<double>(count));
    if (!(last - first >= 2.0)) return {0, count};
    return {static_cast<int>(first), static_cast<int>(last)};
}

PixelWindow window_of(const Image& image, const PixelGrid& grid, const HeightmapRule& rule,
                      const Location& where) {
    PixelWindow window{0, image.height, 0, image.width};
    if (rule.window) {
        const auto& w = *rule.window;
        const auto rows = pixels_within(w[1], w[3], grid.y_m, grid.row_m, image.height);
        const auto columns = pixels_within(w[0], w[2], grid.x_m, grid.column_m, image.width);
        window = {rows[0], rows[1], columns[0], columns[1]};
    }
    if (window.width() * window.height() <= most_heights) return window;
    throw InputError(where, fmt::format("the mission needs {} x {} heights of it, and at most 2^25 "
                                        "have room; make it coarser with gdal_translate -outsize "
                                        "50% 50%, or cut a part out with gdal_translate -projwin",
                                        window.width(), window.height()));
}

/// The two triangles of every four neighbours whose heights are known. Counter-clockwise as seen
/// from above where rows run to the south and columns to the east.
std::vector<std::uint32_t> corners_of_cells(const PixelWindow& window,
                                            const std::vector<bool>& known, bool mirrored) {
    const std::size_t width = window.width();
    std::vector<std::uint32_t> corners;
    corners.reserve(6 * (width - 1) * (window.height() - 1));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        if (!known[a] || !known[b] || !known[c]) return;
        if (mirrored) std::swap(b, c);
        corners.push_back(static_cast<std::uint32_t>(a));
        corners.push_back(static_cast<std::uint32_t>(b));
        corners.push_back(static_cast<std::uint32_t>(c));
    };
    for (std::size_t row = 0; row + 1 < window.height(); ++row) {
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

/// The pixels of a window.
struct HeightGrid {
    std::vector<float> positions;  ///< column, row and value of each
    std::vector<bool> known;       ///< false for those without a height
};

HeightGrid heights_of(const Image& image, const PixelWindow& window, const UnknownHeights& unknown,
                      const Location& where) {
    HeightGrid out;
    const std::size_t count = window.width() * window.height();
    out.positions.reserve(3 * count);
    out.known.reserve(count);
    for (int row = window.first_row; row < window.last_row; ++row) {
        for (int column = window.first_column; column < window.last_column; ++column) {
            const float value = *image.pixel(row, column);
            const bool is_known = !unknown.has(value);
            if (is_known) unknown.require_height(value, row, column, where);
            out.known.push_back(is_known);
            out.positions.push_back(static_cast<float>(column));
            out.positions.push_back(static_cast<float>(row));
            out.positions.push_back(value);
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
    const Image image = read_image(path);
    require_heights(image, where);
    const PixelGrid grid = grid_of(image, rule, where);
    const UnknownHeights unknown(rule.no_data ? rule.no_data : image.reference.no_data);
    const PixelWindow window = window_of(image, grid, rule, where);
    const HeightGrid heights = heights_of(image, window, unknown, where);
    const std::vector<std::uint32_t> corners =
        corners_of_cells(window, heights.known, grid.column_m * grid.row_m > 0.0);
    if (corners.empty())
        throw InputError(where, "has no three neighbours with known heights; check no_data");
    tinygltf::Model model;
    const int positions = add_accessor(model, heights.positions, heights.known.size(),
                                       TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    const int indices = add_accessor(model, corners, corners.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    add_height_node(model, grid, positions, indices);
    return model;
}

}  // namespace sonarsim
