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

inline bool has_area(const std::array<Eigen::Vector3d, 3>& p) {
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm() > 0.0;
}

inline bool is_finite(const std::array<Eigen::Vector3d, 3>& p) {
    return p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
}

/// Limits the work of reading a scene, since a small file can place a large mesh, or many small
/// ones, many times. InputError with `file` beyond the limit.
struct ReadingLimit {
    std::size_t work = 0;

    void add(std::size_t triangles, const Location& file);
};

/// The surface of one glTF primitive.
struct PrimitiveSurface {
    bool has_floats;                         ///< its positions are no integers
    std::vector<Eigen::Vector3d> positions;  ///< the vertices in the mesh's own axes
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads a primitive of triangles, a strip or a fan; nullopt for points and lines. Normalised
/// integers become numbers in [-1, 1]. InputError at `where`, or by `limit` for the whole `file`.
std::optional<PrimitiveSurface> read_surface(const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive,
                                             const Location& where, const Location& file,
                                             ReadingLimit& limit);

}  // namespace sonarsim
