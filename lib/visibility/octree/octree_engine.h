#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

struct OctreeOptions {
    double leaf_m = 0.0;          ///< edge of the leaves; 0: what the view's bins call for
    std::size_t memory_mb = 512;  ///< above this, what no ping has seen for longest is dropped
    bool literal = false;         ///< the paper to the letter: leaf centres, one leaf one vote
};

struct OctreeStatistics {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;  ///< nodes without children
    std::uint64_t facets = 0;  ///< pieces of surface held by all nodes
    std::uint64_t bytes = 0;
    std::uint64_t ping_bytes = 0;  ///< that the most demanding ping so far needed
    std::uint64_t evictions = 0;   ///< subtrees dropped so far
    double leaf_area_m2 = 0.0;     ///< the surface held by all leaves
};

/// The octree engine. The tree grows with the pings that it serves; what a ping sees does not
/// depend on those before it.
class OctreeEngine : public VisibilityEngine {
  public:
    virtual OctreeStatistics statistics() const = 0;
};

/// `scene` must outlive the engine. Throws InputError when `leaf_m` is negative or so small that
/// the scene is more than 2^30 leaves long.
std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options);

/// The longest scene, along its longest side, that these options can divide into leaves: 2^30 of
/// them, less one at either end.
double longest_octree_scene_m(const OctreeOptions& options);

}  // namespace sonarsim
