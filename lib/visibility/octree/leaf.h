#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"

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

/// Integrals over surface, relative to a given point.
struct Moments {
    double area = 0.0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< integral of p dA
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< integral of p p^T dA
};

Moments moments(const Polygon& polygon, const Eigen::Vector3d& relative_to);

/// A patch of the surface inside a node's cube: the parallelogram with the same centroid and second
/// moments. Scene-local, m.
struct LeafFacet {
    Eigen::Vector3f centre;
    Eigen::Vector3f normal;  ///< area-weighted mean, unit
    Eigen::Vector3f edge_u;  ///< half an edge, perpendicular to the normal and to edge_v
    Eigen::Vector3f edge_v;
    float area_m2;
    float thickness_m;       ///< largest distance of the surface from the plane, on either side
    std::uint32_t triangle;  ///< the largest of its triangles, for material and instance
};

/// True if the facet equals its surface: a flat rectangle.
bool is_flat_rectangle(const LeafFacet& facet);

/// Converts the triangles inside a cube to facets.
class LeafMaker {
  public:
    LeafMaker(const Scene& scene, const Caster& caster) : scene_(&scene), caster_(&caster) {}

    Triangle triangle(std::uint32_t index) const;

    /// Clips `triangles` to the cube and appends at most six facets, the largest first: one for
    /// each direction of the normal and material. The result depends only on the cube and the
    /// triangles in it. At most a millionth of a triangle is lost to rounding. Returns the number
    /// of facets appended.
    int append(const Cube& cube, std::span<const std::uint32_t> triangles,
               std::vector<LeafFacet>& facets) const;

  private:
    const Scene* scene_;
    const Caster* caster_;
};

}  // namespace sonarsim
