#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"
#include "visibility/octree/clip.h"

namespace sonarsim {

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

/// Facets as a structure of arrays, so that loops over them vectorise.
struct FacetArrays {
    static constexpr int centre = 0, normal = 3, edge_u = 6, edge_v = 9, area = 12, thickness = 13;

    std::array<std::vector<float>, 14> values;  ///< the floats of LeafFacet, in its order
    std::vector<std::uint32_t> triangle;

    std::uint32_t size() const { return static_cast<std::uint32_t>(triangle.size()); }
    void push_back(const LeafFacet& facet);
    LeafFacet at(std::uint32_t index) const;
    void shrink_to_fit();
    std::size_t bytes() const;
};

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
               FacetArrays& facets) const;

  private:
    const Scene* scene_;
    const Caster* caster_;
};

/// True if the facet equals its surface: a flat rectangle.
bool is_flat_rectangle(const LeafFacet& facet);

}  // namespace sonarsim
