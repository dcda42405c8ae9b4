#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/visibility/clusters.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The clusters that may lie in a view, scene-local.
struct ClustersInView {
    const ClusterMesh& own;                   ///< the scene's own surface,
    std::vector<std::uint32_t> own_clusters;  ///< and which of its clusters
    ClusterMesh placed;                       ///< bodies and copies

    /// Facets of `placed` follow the own ones.
    const ClusterFacet& facet(std::uint32_t index) const {
        return index < own.facets.size() ? own.facets[index]
                                         : placed.facets[index - own.facets.size()];
    }
};

/// The triangles of a scene in clusters: its own, scene-local, and those of its bodies and shared
/// meshes in their own frames.
class SceneClusters {
  public:
    /// `scene` must outlive it.
    explicit SceneClusters(const Scene& scene);

    /// Without their poses bodies are left out. The clusters must outlive the result.
    ClustersInView in_view(const View& view, Pose T_world_sensor,
                           std::span<const Pose> T_world_body) const;

  private:
    struct PlacedMesh {
        ClusterMesh clusters;
        Ball whole;
    };

    const Scene& scene_;
    ClusterMesh own_;
    std::vector<PlacedMesh> bodies_, shared_;
};

}  // namespace sonarsim
