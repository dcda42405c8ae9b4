#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace sonarsim {

/// The vertices of a triangle.
using TriangleCorners = std::array<std::uint32_t, 3>;

/// Twice the area of a triangle along its normal. In float a needle's would cancel.
inline Eigen::Vector3d cross_of(std::span<const Eigen::Vector3f> vertices,
                                const TriangleCorners& triangle) {
    const Eigen::Vector3d a = vertices[triangle[0]].cast<double>();
    return (vertices[triangle[1]].cast<double>() - a)
        .cross(vertices[triangle[2]].cast<double>() - a);
}

/// A ball around the vertices of some triangles.
struct Ball {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius_m = 0.0F;
};
Ball ball_around(std::span<const Eigen::Vector3f> vertices,
                 std::span<const TriangleCorners> triangles);

/// For each vertex the first one at its place. Files repeat vertices at creases and seams.
std::vector<std::uint32_t> first_at_place(std::span<const Eigen::Vector3f> vertices);

/// A side of a triangle, from corner `side` to the next.
struct MeshSide {
    std::uint32_t low, high;  ///< vertices
    std::uint32_t triangle;
    std::uint32_t side;
    bool forward;  ///< from the low vertex to the high one
};

/// The sides of all triangles, those of an edge in a row. `vertices` is the number of vertices.
std::vector<MeshSide> sides_by_edge(std::span<const TriangleCorners> triangles,
                                    std::size_t vertices);

/// A closed part of a mesh: from outside its box, sides that face the eye hide all others.
struct Solid {
    Eigen::AlignedBox3f box;
    float outward = 0.0F;  ///< 1: its normals point outwards, -1: inwards, 0: no solid
};

/// The solids of a mesh.
struct Solids {
    std::vector<Solid> items = {{}};          ///< the first stands for open parts
    std::vector<std::uint32_t> of_triangles;  ///< indices into `items`
};

/// Parts whose triangles share vertices are solids if each edge occurs as often from its one end as
/// from its other, and the part has a volume and, at some points, does not cross itself.
Solids find_solids(std::span<const Eigen::Vector3f> vertices,
                   std::span<const TriangleCorners> triangles);

/// Disjoint sets of the numbers from 0 to before `count` (union-find).
class JoinedSets {
  public:
    explicit JoinedSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    /// The number that stands for the set of `k`.
    std::uint32_t of(std::uint32_t k) {
        while (parent_[k] != k)
            k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    /// Joins the sets of `a` and `b`.
    void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace sonarsim
