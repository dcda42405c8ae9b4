#pragma once

#include <tiny_gltf.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sonarsim {

/// Elements of a glTF accessor, read one by one from the model's buffers: strided, sparse or both.
/// The functions that open an accessor check that all its bytes exist.
struct Accessor {
    const unsigned char* data = nullptr;  ///< null: elements that are not sparse are 0
    std::size_t stride = 0;
    std::size_t count = 0;
    int component_type = 0;
    bool is_normalized = false;
    std::size_t element_bytes = 0;
    std::vector<std::uint32_t> sparse_at;  ///< indices of the replaced elements, ascending
    const unsigned char* sparse_values = nullptr;
};

/// Opens accessor `index` for positions (VEC3) or for vertex indices (SCALAR, unsigned). InputError
/// starting with `where` if its type is wrong or it claims more than its buffer holds.
Accessor open_positions(const tinygltf::Model& model, int index, const std::string& where);
Accessor open_indices(const tinygltf::Model& model, int index, const std::string& where);

/// Element `i` < count. Normalised integers become numbers in [-1, 1].
Eigen::Vector3d position(const Accessor& accessor, std::size_t i);
std::uint32_t vertex_index(const Accessor& accessor, std::size_t i);

}  // namespace sonarsim
