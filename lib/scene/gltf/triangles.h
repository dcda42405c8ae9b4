#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "scene/gltf/accessor.h"

namespace sonarsim {

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

/// Opens a primitive of triangles, a strip or a fan; nullopt for points and lines. InputError
/// starting with `where`.
std::optional<TriangleSource> open_triangles(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const std::string& where);

/// The vertices of triangle `i` < count, all below positions.count. InputError starting with
/// `where` if an index is not.
std::array<std::uint32_t, 3> triangle(const TriangleSource& source, std::size_t i,
                                      const std::string& where);

}  // namespace sonarsim
