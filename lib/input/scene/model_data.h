#pragma once

#include <tiny_gltf.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

// Surfaces as tinygltf's structs, for what is not a glTF file.

namespace sonarsim {

/// Appends numbers to the first buffer of a model, and returns the index of a new accessor to them.
/// `count` is its number of elements; `component` and `type` are tinygltf's constants.
template <class T>
int add_accessor(tinygltf::Model& model, const std::vector<T>& values, std::size_t count,
                 int component, int type) {
    if (model.buffers.empty()) model.buffers.emplace_back();
    auto& data = model.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    data.resize(data.size() + view.byteLength);
    // memcpy takes no null pointer, which an empty vector may have.
    if (!values.empty()) std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    model.bufferViews.push_back(std::move(view));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
}

/// An accessor to x, y and z of each vertex.
inline int add_positions(tinygltf::Model& model, const std::vector<float>& positions) {
    return add_accessor(model, positions, positions.size() / 3, TINYGLTF_COMPONENT_TYPE_FLOAT,
                        TINYGLTF_TYPE_VEC3);
}

/// Adds triangles, by the three vertices of each, to a mesh. `material` is an index; -1: none.
inline void add_triangles(tinygltf::Model& model, int mesh, int positions,
                          const std::vector<std::uint32_t>& corners, int material) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = add_accessor(model, corners, corners.size(),
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    primitive.material = material;
    model.meshes[static_cast<std::size_t>(mesh)].primitives.push_back(std::move(primitive));
}

/// The index of a new mesh.
inline int add_mesh(tinygltf::Model& model, const std::string& name) {
    model.meshes.emplace_back().name = name;
    return static_cast<int>(model.meshes.size()) - 1;
}

inline tinygltf::Node& add_node(tinygltf::Model& model, const std::string& name, int mesh) {
    tinygltf::Node& node = model.nodes.emplace_back();
    node.name = name;
    node.mesh = mesh;
    return node;
}

/// The matrix of a node whose vertices are (column, row, height) of a grid: the size of a step
/// along columns and rows, and the place of the first vertex.
inline std::vector<double> grid_matrix(double column_m, double row_m, double x_m, double y_m) {
    return {column_m, 0.0, 0.0, 0.0, 0.0, row_m, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x_m, y_m, 0.0, 1.0};
}

/// (column, row, height) of a grid, row by row, from `first` on; `parts` vertices make a step.
inline std::vector<float> grid_positions(const std::vector<float>& heights, std::size_t columns,
                                         const Eigen::Array2f& first = Eigen::Array2f::Zero(),
                                         const Eigen::Array2f& parts = Eigen::Array2f::Ones()) {
    std::vector<float> positions;
    positions.reserve(3 * heights.size());
    for (std::size_t k = 0; k < heights.size(); ++k) {
        const Eigen::Array2f at = first + Eigen::Array2f(k % columns, k / columns) / parts;
        positions.insert(positions.end(), {at.x(), at.y(), heights[k]});
    }
    return positions;
}

/// The index of the material of this name, which is added if need be; -1 for one without a name.
inline int material_number(tinygltf::Model& model, const std::string& name) {
    if (name.empty()) return -1;
    const auto found = std::ranges::find(model.materials, name, &tinygltf::Material::name);
    const auto index = static_cast<int>(found - model.materials.begin());
    if (found == model.materials.end()) model.materials.emplace_back().name = name;
    return index;
}

}  // namespace sonarsim
