#include "scene/seabed/bed_model.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/model_data.h"

namespace sonarsim {

namespace {

constexpr const char* bed_node = "seabed";

/// Column, row and height of each vertex.
std::vector<float> vertices_of(const Seabed& bed) {
    std::vector<float> out;
    out.reserve(3 * bed.heights.size());
    std::size_t i = 0;
    for (int row = 0; row < bed.grid.rows; ++row) {
        for (int column = 0; column < bed.grid.columns; ++column, ++i) {
            out.push_back(static_cast<float>(column));
            out.push_back(static_cast<float>(row));
            out.push_back(bed.heights[i]);
        }
    }
    return out;
}

std::vector<std::uint32_t> corners_of(const BedGrid& grid) {
    const auto width = static_cast<std::uint32_t>(grid.columns);
    const auto height = static_cast<std::uint32_t>(grid.rows);
    std::vector<std::uint32_t> out;
    out.reserve(std::size_t{6} * (width - 1) * (height - 1));
    for (std::uint32_t row = 0; row + 1 < height; ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t north_west = row * width + column;
            const std::uint32_t south_west = north_west + width;
            for (const std::uint32_t corner : {north_west, south_west, south_west + 1, north_west,
                                               south_west + 1, north_west + 1})
                out.push_back(corner);
        }
    }
    return out;
}

void set_class(tinygltf::Node& node, const std::string& name) {
    if (name.empty()) return;
    const tinygltf::Value::Object sonar{{"class", tinygltf::Value(name)}};
    node.extras = tinygltf::Value(tinygltf::Value::Object{{"sonar", tinygltf::Value(sonar)}});
}

}  // namespace

tinygltf::Model bed_model(const Seabed& bed) {
    const BedGrid& grid = bed.grid;
    tinygltf::Model model;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] =
        add_accessor(model, vertices_of(bed), bed.heights.size(), TINYGLTF_COMPONENT_TYPE_FLOAT,
                     TINYGLTF_TYPE_VEC3);
    const std::vector<std::uint32_t> corners = corners_of(grid);
    primitive.indices = add_accessor(model, corners, corners.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    tinygltf::Mesh mesh;
    mesh.name = bed_node;
    mesh.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = bed_node;
    node.mesh = 0;
    node.matrix = {grid.cell_m,
                   0.0,
                   0.0,
                   0.0,  //
                   0.0,
                   -grid.cell_m,
                   0.0,
                   0.0,  //
                   0.0,
                   0.0,
                   1.0,
                   0.0,  //
                   grid.x_m(0) - bed.origin_m[0],
                   grid.y_m(0) - bed.origin_m[1],
                   0.0,
                   1.0};
    set_class(node, bed.class_name);
    model.nodes.push_back(std::move(node));
    return model;
}

}  // namespace sonarsim
