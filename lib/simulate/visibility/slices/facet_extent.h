#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "simulate/visibility/slices/setup.h"

namespace sonarsim {

/// The extent of a facet's surface.
struct FacetExtent {
    Interval u;        ///< unbounded, or the whole component's, where it continues in a neighbour
    Interval range_m;  ///< range of the facet; approximate if it continues in a neighbour
};

/// Computes the extents of facets on demand, since few are visible.
class FacetExtents {
  public:
    /// All arguments must outlive it. `vertices` are the scene's.
    FacetExtents(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
                 const SliceSetup& setup, const SliceScene& scene);

    /// The extent of SliceScene::facets[facet_index].
    const FacetExtent& of(std::uint32_t facet_index);

  private:
    Interval u_of(const Corners& corners, std::uint32_t facet) const;
    Interval with_neighbours(const Corners& corners, const FrontFacet& facet, Interval all) const;
    bool goes_on(const Corners& corners, int side, std::uint32_t facet) const;

    const ClusterMesh& mesh_;
    const std::span<const Eigen::Vector3f> vertices_;
    const SliceSetup& setup_;
    const SliceScene& scene_;
    std::vector<FacetExtent> known_;  ///< negative range: not computed yet
};

}  // namespace sonarsim
