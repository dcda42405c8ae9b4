#include "input/scene/seabed/bed_model.h"

#include <cstdint>
#include <string>
#include <vector>

#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

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

/// The triangles of each material. A square between four heights has the material of its
/// north-western one.
std::vector<std::vector<std::uint32_t>> corners_by_material(const Seabed& bed) {
    const auto width = static_cast<std::uint32_t>(bed.grid.columns);
    const auto height = static_cast<std::uint32_t>(bed.grid.rows);
    std::vector<std::vector<std::uint32_t>> out(bed.materials.size());
    for (std::uint32_t row = 0; row + 1 < height; ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t north_west = row * width + column;
            const std::uint32_t south_west = north_west + width;
            std::vector<std::uint32_t>& corners = out[bed.sediments[north_west]];
            for (const std::uint32_t corner : {north_west, south_west, south_west + 1, north_west,
                                               south_west + 1, north_west + 1})
                corners.push_back(corner);
        }
    }
    return out;
}

void set_class(const std::string& name, tinygltf::Node& node) {
    using tinygltf::Value;
    if (name.empty()) return;
    node.extras = Value(Value::Object{{"sonar", Value(Value::Object{{"class", Value(name)}})}});
}

int add_rock_shape(const Surface& surface, int material, tinygltf::Model& model) {
    std::vector<float> positions;
    for (const Eigen::Vector3d& vertex : surface.vertices) {
        for (const double x : vertex)
            positions.push_back(static_cast<float>(x));
    }
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : surface.triangles)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    const int mesh = add_mesh(model, "rock");
    add_triangles(model, mesh, add_positions(model, positions), corners, material);
    return mesh;
}

}  // namespace

tinygltf::Model bed_model(const Seabed& bed) {
    tinygltf::Model model;
    const int ground = add_mesh(model, "seabed");
    const int positions = add_positions(model, vertices_of(bed));
    const auto corners = corners_by_material(bed);
    for (std::size_t m = 0; m < corners.size(); ++m) {
        if (corners[m].empty()) continue;
        add_triangles(model, ground, positions, corners[m],
                      material_number(model, bed.materials[m]));
    }
    tinygltf::Node& node = add_node(model, "seabed", ground);
    node.matrix = grid_matrix(bed.grid.cell_m, -bed.grid.cell_m, bed.grid.x_m(0), bed.grid.y_m(0));
    set_class(bed.class_name, node);
    const std::string& rocks_material =
        bed.rock_material.empty() ? bed.materials.front() : bed.rock_material;
    std::vector<int> mesh_of_shape(bed.rock_shapes.size(), -1);
    for (std::size_t i = 0; i < bed.rocks.size(); ++i) {
        const Rock& rock = bed.rocks[i];
        int& mesh = mesh_of_shape[rock.shape];
        if (mesh < 0) {
            mesh = add_rock_shape(bed.rock_shapes[rock.shape],
                                  material_number(model, rocks_material), model);
        }
        const Eigen::Matrix4d& matrix = rock.T_world_shape.matrix();
        tinygltf::Node& placed = add_node(model, rock_name(i), mesh);
        placed.matrix.assign(matrix.data(), matrix.data() + matrix.size());
        set_class(rock_class, placed);
    }
    return model;
}

}  // namespace sonarsim
