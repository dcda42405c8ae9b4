#include "scene/heightmap/height_model.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/error.h"
#include "scene/heightmap/height_field.h"
#include "scene/model_data.h"

namespace sonarsim {

namespace {

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

/// The heights that become vertices.
struct HeightVertices {
    std::vector<float> positions;  ///< column, row and value of each
    std::vector<bool> known;       ///< false for those without a height
    std::size_t width = 0;         ///< vertices of a row
};

HeightVertices vertices_of(const HeightField& field) {
    const PixelWindow& window = field.window;
    HeightVertices out;
    out.width = window.width();
    out.positions.reserve(3 * field.heights.size());
    out.known.reserve(field.heights.size());
    for (int row = window.first_row; row < window.last_row; ++row) {
        for (int column = window.first_column; column < window.last_column; ++column) {
            const std::size_t k = field.index(row, column);
            out.known.push_back(field.known[k]);
            out.positions.push_back(static_cast<float>(column));
            out.positions.push_back(static_cast<float>(row));
            out.positions.push_back(field.heights[k]);
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

tinygltf::Model height_model(const std::filesystem::path& path, const HeightmapRule& rule,
                             ImageReader& images) {
    const HeightField field = read_heights(path, rule, images);
    const PixelGrid& grid = field.grid;
    const HeightVertices vertices = vertices_of(field);
    const std::vector<std::uint32_t> corners =
        corners_of_cells(vertices.width, vertices.known, grid.column_m * grid.row_m > 0.0);
    if (corners.empty())
        throw InputError(Location{path.string()},
                         "has no three neighbours with known heights; check no_data");
    tinygltf::Model model;
    const int positions = add_accessor(model, vertices.positions, vertices.known.size(),
                                       TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    const int indices = add_accessor(model, corners, corners.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    add_height_node(model, grid, positions, indices);
    return model;
}

}  // namespace sonarsim
