#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "visibility/slices/setup.h"

namespace sonarsim {

/// How far a triangle's surface reaches.
struct Reach {
    Extent u;        ///< where it ends, or the whole piece where it goes on with a neighbour
    Extent range_m;  ///< within which all of it lies; of a triangle that goes on, nearly all
};

/// Works out the reach of a scene's facets when it is asked for: few are visible.
class Reaches {
  public:
    /// All arguments must outlive it. `vertices` are the scene's.
    Reaches(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
            const SliceSetup& setup, const SliceScene& scene);

    /// Of SliceScene::facets[seen].
    const Reach& of(std::uint32_t seen);

  private:
    Extent u_of(const Corners& corners, std::uint32_t facet) const;
    bool goes_on(const Corners& corners, int side, std::uint32_t facet) const;

    const ClusterMesh& mesh_;
    const std::span<const Eigen::Vector3f> vertices_;
    const SliceSetup& setup_;
    const SliceScene& scene_;
    std::vector<Reach> known_;  ///< those not asked for have a negative range
};

}  // namespace sonarsim
