#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "simulate/visibility/caster.h"

namespace sonarsim {

/// A half-open cube [min, min + edge), scene-local, m.
struct Cube {
    Eigen::Vector3d min;
    double edge;
};

using Triangle = std::array<Eigen::Vector3d, 3>;

/// A convex, planar polygon: a triangle after clipping by up to six planes.
struct Polygon {
    std::array<Eigen::Vector3d, 9> corner;
    int corners = 0;
};

/// False if no part of the triangle's bounding box is in the cube.
bool overlaps(const Triangle& triangle, const Cube& cube);

/// The part of a triangle inside a cube; no corners if there is none. Surface in a face between two
/// cubes belongs to the cube above the face.
Polygon clip(const Triangle& triangle, const Cube& cube);

double area_m2(const Polygon& polygon);

/// The surface inside a cube: that of the direction and material with the largest area.
struct Leaf {
    Eigen::Vector3f normal;  ///< area-weighted mean, unit, scene-local
    std::uint32_t triangle;  ///< the largest of its triangles, for material and instance
};

Triangle triangle_of(const Scene& scene, std::uint32_t index);

/// The leaf of a cube; nothing if none of `triangles` has surface in it. At most a millionth of a
/// triangle is lost to rounding.
std::optional<Leaf> leaf_of(const Cube& cube, std::span<const std::uint32_t> triangles,
                            const Scene& scene, const Caster& caster);

}  // namespace sonarsim
