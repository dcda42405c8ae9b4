#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/error.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_count = std::size_t{1} << 28;
/// Elements without a bufferView are zeros, which take memory and no bytes of the file.
constexpr std::size_t max_zeros = std::size_t{1} << 20;

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

template <class T>
double number(const unsigned char* bytes, bool is_normalized) {
    const auto value = static_cast<double>(load<T>(bytes));
    if (!is_normalized) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

template <class T>
Eigen::Vector3d three(const unsigned char* bytes, bool is_normalized) {
    return {number<T>(bytes, is_normalized), number<T>(bytes + sizeof(T), is_normalized),
            number<T>(bytes + 2 * sizeof(T), is_normalized)};
}

std::uint32_t unsigned_value(const unsigned char* bytes, int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool is_index_type(int component_type) {
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool is_position_type(int component_type) {
    return component_type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

struct Elements {
    const unsigned char* data;
    std::size_t stride;
};

/// Finds `count` >= 1 elements from `offset` on in a buffer view and checks that they lie within
/// their buffer.
Elements locate(const tinygltf::Model& model, int view_index, std::size_t offset,
                std::size_t element_bytes, std::size_t count, const std::string& where) {
    const std::string name = "bufferView " + std::to_string(view_index);
    if (static_cast<std::size_t>(view_index) >= model.bufferViews.size()) {
        throw InputError(where + ": " + name + " does not exist");
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
    if (static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
        throw InputError(where + ": " + name + " lies in buffer " + std::to_string(view.buffer) +
                         ", which does not exist");
    }
    const auto& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
        throw InputError(where + ": " + name + " reaches beyond the end of its buffer (" +
                         std::to_string(bytes.size()) + " bytes)");
    }
    const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
    if (stride < element_bytes) {
        throw InputError(where + ": byteStride " + std::to_string(stride) +
                         " is less than the size of an element, " + std::to_string(element_bytes));
    }
    // `max_count` limits the count, and strides are at most 252, so that this does not overflow.
    const std::size_t needed = stride * (count - 1) + element_bytes;
    if (needed > view.byteLength || offset > view.byteLength - needed) {
        throw InputError(where + ": claims " + std::to_string(count) + " elements; " + name +
                         " is too short for them (" + std::to_string(view.byteLength) + " bytes)");
    }
    return {bytes.data() + view.byteOffset + offset, stride};
}

void open_sparse(const tinygltf::Model& model, const tinygltf::Accessor& from, Accessor& to,
                 const std::string& where) {
    const auto& sparse = from.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    if (count == 0 || count > to.count) {
        throw InputError(where + ": sparse count " + std::to_string(count) +
                         " is not between 1 and the accessor's " + std::to_string(to.count));
    }
    const int type = sparse.indices.componentType;
    if (!is_index_type(type)) {
        throw InputError(where + ": sparse indices must be unsigned integers");
    }
    const auto index_bytes = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
    const Elements indices = locate(model, sparse.indices.bufferView,
                                    static_cast<std::size_t>(sparse.indices.byteOffset),
                                    index_bytes, count, where + ": sparse indices");
    // Sparse values are tightly packed: glTF allows no stride for them.
    const Elements values =
        locate(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
               to.element_bytes, count, where + ": sparse values");
    if (values.stride != to.element_bytes) {
        throw InputError(where + ": sparse values may not have a byteStride");
    }
    to.sparse_values = values.data;
    to.sparse_at.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = unsigned_value(indices.data + i * indices.stride, type);
        if (at >= to.count || (i > 0 && at <= to.sparse_at.back())) {
            throw InputError(where + ": sparse indices must ascend and stay below " +
                             std::to_string(to.count));
        }
        to.sparse_at.push_back(at);
    }
}

Accessor open(const tinygltf::Model& model, int index, int type, std::size_t components,
              const std::string& where) {
    const tinygltf::Accessor& from = model.accessors[static_cast<std::size_t>(index)];
    if (from.type != type) {
        throw InputError(where + ": expected an accessor of type " +
                         (components == 1 ? "SCALAR" : "VEC3"));
    }
    if (from.count == 0 || from.count > max_count) {
        throw InputError(where + ": count " + std::to_string(from.count) +
                         " is not between 1 and " + std::to_string(max_count));
    }
    Accessor to;
    to.count = from.count;
    to.component_type = from.componentType;
    to.is_normalized = from.normalized;
    to.element_bytes = components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                        static_cast<std::uint32_t>(from.componentType)));
    if (from.bufferView >= 0) {
        const Elements elements =
            locate(model, from.bufferView, from.byteOffset, to.element_bytes, to.count, where);
        to.data = elements.data;
        to.stride = elements.stride;
    } else if (!from.sparse.isSparse) {
        throw InputError(where + ": has neither a bufferView nor sparse elements");
    } else if (from.count > max_zeros) {
        throw InputError(where + ": count " + std::to_string(from.count) +
                         " needs a bufferView; without one it is at most " +
                         std::to_string(max_zeros));
    }
    if (from.sparse.isSparse) open_sparse(model, from, to, where);
    return to;
}

void check_exists(const tinygltf::Model& model, int index, const std::string& where) {
    if (static_cast<std::size_t>(index) >= model.accessors.size()) {
        throw InputError(where + ": accessor " + std::to_string(index) + " does not exist");
    }
}

const unsigned char* element(const Accessor& accessor, std::size_t i) {
    const auto& at = accessor.sparse_at;
    if (!at.empty()) {
        const auto found = std::lower_bound(at.begin(), at.end(), i);
        if (found != at.end() && *found == i) {
            const auto k = static_cast<std::size_t>(found - at.begin());
            return accessor.sparse_values + k * accessor.element_bytes;
        }
    }
    return accessor.data ? accessor.data + i * accessor.stride : nullptr;
}

}  // namespace

Accessor open_positions(const tinygltf::Model& model, int index, const std::string& where) {
    check_exists(model, index, where);
    if (!is_position_type(model.accessors[static_cast<std::size_t>(index)].componentType)) {
        throw InputError(where + ": positions must be float, or 8- or 16-bit integers");
    }
    return open(model, index, TINYGLTF_TYPE_VEC3, 3, where);
}

Accessor open_indices(const tinygltf::Model& model, int index, const std::string& where) {
    check_exists(model, index, where);
    if (!is_index_type(model.accessors[static_cast<std::size_t>(index)].componentType)) {
        throw InputError(where + ": indices must be unsigned 8-, 16- or 32-bit integers");
    }
    return open(model, index, TINYGLTF_TYPE_SCALAR, 1, where);
}

Eigen::Vector3d position(const Accessor& accessor, std::size_t i) {
    const unsigned char* bytes = element(accessor, i);
    if (!bytes) return Eigen::Vector3d::Zero();
    const bool is_normalized = accessor.is_normalized;
    switch (accessor.component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return three<std::int8_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return three<std::uint8_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return three<std::int16_t>(bytes, is_normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return three<std::uint16_t>(bytes, is_normalized);
        default:
            return three<float>(bytes, false);
    }
}

std::uint32_t vertex_index(const Accessor& accessor, std::size_t i) {
    const unsigned char* bytes = element(accessor, i);
    return bytes ? unsigned_value(bytes, accessor.component_type) : 0;
}

}  // namespace sonarsim
