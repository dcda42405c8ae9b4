#include <spdlog/fmt/fmt.h>

#include <cstring>
#include <limits>
#include <type_traits>

#include "input/scene/gltf/primitives.h"

namespace sonarsim {

namespace {

/// Bytes of a buffer, in equal steps.
struct Elements {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;

    const unsigned char* at(std::size_t i) const { return data + i * stride; }
};

/// A type of numbers in a file.
struct ComponentType {
    int number;  ///< glTF's number of the type
    std::size_t bytes;
    bool is_index, is_position;  ///< it is allowed for these
    double (*read)(const unsigned char* bytes, bool is_normalized);
};

/// Elements of a glTF accessor, read from the model's buffers: strided, sparse or both.
/// The functions that open an accessor check that all its bytes exist.
struct Accessor {
    Elements elements;  ///< without data: elements that are not sparse are 0
    std::size_t count = 0;
    const ComponentType* component = nullptr;
    bool is_normalized = false;
    std::vector<std::uint32_t> sparse_at;  ///< indices of the replaced elements, ascending
    Elements sparse;                       ///< their values
};

/// The accessors of the triangles of one primitive.
struct TriangleSource {
    Accessor positions;
    std::optional<Accessor> indices;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::size_t count = 0;
};

constexpr std::size_t max_count = std::size_t{1} << 28;
/// Elements without a bufferView are zeros, which take memory and no bytes of the file.
constexpr std::size_t max_zeros = std::size_t{1} << 20;

template <class T>
double number(const unsigned char* bytes, bool is_normalized) {
    T stored;
    std::memcpy(&stored, bytes, sizeof(T));
    const auto value = static_cast<double>(stored);
    if (!is_normalized || std::is_floating_point_v<T>) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

template <class T>
constexpr ComponentType component(int number_of_type, bool is_index, bool is_position) {
    return {number_of_type, sizeof(T), is_index, is_position, number<T>};
}

constexpr ComponentType component_types[] = {
    component<std::int8_t>(TINYGLTF_COMPONENT_TYPE_BYTE, false, true),
    component<std::uint8_t>(TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, true, true),
    component<std::int16_t>(TINYGLTF_COMPONENT_TYPE_SHORT, false, true),
    component<std::uint16_t>(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, true, true),
    component<std::uint32_t>(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, true, false),
    component<float>(TINYGLTF_COMPONENT_TYPE_FLOAT, false, true)};

/// Null for a number that is none of glTF's.
const ComponentType* component_of(int number_of_type) {
    const auto* const found =
        std::ranges::find(component_types, number_of_type, &ComponentType::number);
    return found == std::end(component_types) ? nullptr : found;
}

/// Finds `count` >= 1 elements from `offset` on in a buffer view, which lie within their buffer.
Elements locate(const tinygltf::Model& model, int view_index, std::size_t offset,
                std::size_t element_bytes, std::size_t count, const Location& where) {
    const std::string name = fmt::format("bufferView {}", view_index);
    const auto index = static_cast<std::size_t>(view_index);
    if (index >= model.bufferViews.size()) refuse(where, "{} does not exist", name);
    const tinygltf::BufferView& view = model.bufferViews[index];
    const auto buffer = static_cast<std::size_t>(view.buffer);
    if (buffer >= model.buffers.size())
        refuse(where, "{} lies in buffer {}, which does not exist", name, view.buffer);
    const auto& bytes = model.buffers[buffer].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
        refuse(where, "{} reaches beyond the end of its buffer ({} bytes)", name, bytes.size());
    }
    const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
    if (stride < element_bytes) {
        refuse(where, "byteStride {} is less than the size of an element, {}", stride,
               element_bytes);
    }
    // `max_count` limits the count, and strides are at most 252, so that this does not overflow.
    const std::size_t needed = stride * (count - 1) + element_bytes;
    if (needed > view.byteLength || offset > view.byteLength - needed) {
        refuse(where, "claims {} elements; {} is too short for them ({} bytes)", count, name,
               view.byteLength);
    }
    return {bytes.data() + view.byteOffset + offset, stride};
}

void open_sparse(const tinygltf::Model& model, const tinygltf::Accessor& from,
                 std::size_t element_bytes, Accessor& to, const Location& where) {
    const auto& sparse = from.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    if (count == 0 || count > to.count) {
        refuse(where, "sparse count {} is not between 1 and the accessor's {}", count, to.count);
    }
    const ComponentType* const type = component_of(sparse.indices.componentType);
    if (!type || !type->is_index) refuse(where, "sparse indices must be unsigned integers");
    const Elements indices = locate(model, sparse.indices.bufferView,
                                    static_cast<std::size_t>(sparse.indices.byteOffset),
                                    type->bytes, count, {where.file + ": sparse indices"});
    to.sparse =
        locate(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
               element_bytes, count, {where.file + ": sparse values"});
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::uint32_t>(type->read(indices.at(i), false));
        if (at >= to.count || (i > 0 && at <= to.sparse_at.back()))
            refuse(where, "sparse indices must ascend and stay below {}", to.count);
        to.sparse_at.push_back(at);
    }
}

/// An accessor to positions (VEC3), or to vertex indices (SCALAR, unsigned). InputError at
/// `where` if its type is wrong or it claims more than its buffer holds.
Accessor open_accessor(const tinygltf::Model& model, int index, bool is_positions,
                       const Location& where) {
    if (static_cast<std::size_t>(index) >= model.accessors.size())
        refuse(where, "accessor {} does not exist", index);
    const tinygltf::Accessor& from = model.accessors[static_cast<std::size_t>(index)];
    const ComponentType* const type = component_of(from.componentType);
    if (is_positions && !(type && type->is_position))
        refuse(where, "positions must be float, or 8- or 16-bit integers");
    if (!is_positions && !(type && type->is_index))
        refuse(where, "indices must be unsigned 8-, 16- or 32-bit integers");
    if (from.type != (is_positions ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_SCALAR))
        refuse(where, "expected an accessor of type {}", is_positions ? "VEC3" : "SCALAR");
    if (from.count == 0 || from.count > max_count)
        refuse(where, "count {} is not between 1 and {}", from.count, max_count);
    Accessor to;
    to.count = from.count;
    to.component = type;
    to.is_normalized = from.normalized;
    const std::size_t element_bytes = (is_positions ? 3 : 1) * type->bytes;
    if (from.bufferView >= 0) {
        to.elements =
            locate(model, from.bufferView, from.byteOffset, element_bytes, to.count, where);
    } else if (!from.sparse.isSparse) {
        refuse(where, "has neither a bufferView nor sparse elements");
    } else if (from.count > max_zeros) {
        refuse(where, "count {} needs a bufferView; without one it is at most {}", from.count,
               max_zeros);
    }
    if (from.sparse.isSparse) open_sparse(model, from, element_bytes, to, where);
    return to;
}

/// The bytes of an element; null for a zero.
const unsigned char* element(const Accessor& accessor, std::size_t i) {
    const auto& at = accessor.sparse_at;
    const auto found = std::lower_bound(at.begin(), at.end(), i);
    if (found != at.end() && *found == i)
        return accessor.sparse.at(static_cast<std::size_t>(found - at.begin()));
    return accessor.elements.data ? accessor.elements.at(i) : nullptr;
}

std::uint32_t vertex_index(const Accessor& accessor, std::size_t i) {
    const unsigned char* const bytes = element(accessor, i);
    return bytes ? static_cast<std::uint32_t>(accessor.component->read(bytes, false)) : 0;
}

/// The positions of all vertices.
std::vector<Eigen::Vector3d> positions_of(const Accessor& from) {
    std::vector<Eigen::Vector3d> positions(from.count, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < from.count; ++i) {
        const unsigned char* const bytes = element(from, i);
        for (std::size_t k = 0; bytes && k < 3; ++k)
            positions[i][k] =
                from.component->read(bytes + k * from.component->bytes, from.is_normalized);
    }
    return positions;
}

/// The vertices of all triangles. InputError at `where` if there is no such vertex.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const TriangleSource& source,
                                                       const Location& where) {
    std::vector<std::array<std::uint32_t, 3>> triangles(source.count);
    for (std::size_t i = 0; i < source.count; ++i) {
        std::array<std::size_t, 3> corners{i, i + 1, i + 2};
        if (source.mode == TINYGLTF_MODE_TRIANGLES) corners = {3 * i, 3 * i + 1, 3 * i + 2};
        if (source.mode == TINYGLTF_MODE_TRIANGLE_FAN) corners[0] = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = source.indices ? vertex_index(*source.indices, corners[k])
                                                        : static_cast<std::uint32_t>(corners[k]);
            triangles[i][k] = vertex;
            if (vertex < source.positions.count) continue;
            refuse(where, "index {} is out of range; there are {} vertices", vertex,
                   source.positions.count);
        }
    }
    return triangles;
}

}  // namespace

void ReadingLimit::add(std::size_t triangles, const Location& file) {
    constexpr std::size_t max_triangles = std::size_t{1} << 28;
    constexpr std::size_t piece_cost = 64;
    work += piece_cost + triangles;
    if (work > max_triangles)
        refuse(file, "places more than 2^28 triangles (a primitive counts as 64 more)");
}

std::optional<PrimitiveSurface> read_surface(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const Location& where, const Location& file,
                                             ReadingLimit& limit) {
    if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        refuse(where, "mode {} is not one of glTF's, 0 to 6", primitive.mode);
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        limit.add(0, file);
        return std::nullopt;
    }
    const auto attribute = primitive.attributes.find("POSITION");
    if (attribute == primitive.attributes.end()) refuse(where, "has no POSITION");

    TriangleSource source;
    source.mode = primitive.mode;
    source.positions = open_accessor(model, attribute->second, true, {where.file + ": POSITION"});
    if (primitive.indices >= 0)
        source.indices = open_accessor(model, primitive.indices, false, {where.file + ": indices"});
    const std::size_t corners = source.indices ? source.indices->count : source.positions.count;
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (is_list ? corners % 3 != 0 : corners < 3)
        refuse(where, "{} corners do not make whole triangles", corners);
    source.count = is_list ? corners / 3 : corners - 2;
    limit.add(source.count + source.positions.sparse_at.size(), file);
    return PrimitiveSurface{source.positions.component->number == TINYGLTF_COMPONENT_TYPE_FLOAT,
                            positions_of(source.positions), triangles_of(source, where)};
}

}  // namespace sonarsim
