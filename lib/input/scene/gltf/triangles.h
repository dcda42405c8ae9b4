#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/error.h"

namespace sonarsim {

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

inline bool has_area(const std::array<Eigen::Vector3d, 3>& p) {
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm() > 0.0;
}

inline bool is_finite(const std::array<Eigen::Vector3d, 3>& p) {
    return p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
}

/// The triangles of one glTF primitive.
struct TriangleSource {
    Accessor positions;
    std::optional<Accessor> indices;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::size_t count = 0;
};

/// Opens a primitive of triangles, a strip or a fan; nullopt for points and lines. InputError at
/// `where`.
std::optional<TriangleSource> open_triangles(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const Location& where);

/// The positions of all vertices. Normalised integers become numbers in [-1, 1].
std::vector<Eigen::Vector3d> read_positions(const TriangleSource& source);

/// The vertices of all triangles. InputError at `where` if there is no such vertex.
std::vector<std::array<std::uint32_t, 3>> read_triangles(const TriangleSource& source,
                                                         const Location& where);

}  // namespace sonarsim
