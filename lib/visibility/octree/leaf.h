#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"
#include "visibility/octree/clip.h"

namespace sonarsim {

/// A piece of the surface inside a node's cube: the parallelogram with the same centroid and the
/// same second moments. Scene-local, m.
struct LeafFacet {
    Eigen::Vector3f centre;
    Eigen::Vector3f normal;  ///< area-weighted mean, unit
    Eigen::Vector3f edge_u;  ///< half an edge, at right angles to the normal and to edge_v
    Eigen::Vector3f edge_v;
    float area_m2;
    float thickness_m;       ///< by how much the surface strays from the plane, to either side
    std::uint32_t triangle;  ///< the largest of its triangles: gives material and instance
};

/// Facets side by side, so that loops over them vectorise.
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

/// Turns the triangles inside a cube into facets.
class LeafMaker {
  public:
    LeafMaker(const Scene& scene, const Caster& caster) : scene_(&scene), caster_(&caster) {}

    Triangle triangle(std::uint32_t index) const;

    /// Clips `triangles` to the cube and appends what is inside: one facet per direction of the
    /// normal and material, the largest first, six at most. Depends on the cube and the triangles
    /// in it alone. A millionth of a triangle may be lost to rounding in a cube, no more. Returns
    /// how many were appended.
    int append(const Cube& cube, std::span<const std::uint32_t> triangles,
               FacetArrays& facets) const;

  private:
    const Scene* scene_;
    const Caster* caster_;
};

/// Whether the facet is its surface rather than a likeness of it: a flat rectangle.
bool is_flat_rectangle(const LeafFacet& facet);

}  // namespace sonarsim
