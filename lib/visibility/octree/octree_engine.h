#pragma once

#include <memory>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/options.h"

namespace sonarsim {

/// The octree engine. The tree grows as pings are prepared; the result of a ping does not depend on
/// earlier pings.
class OctreeEngine : public VisibilityEngine {
  public:
    virtual OctreeStatistics statistics() const = 0;
};

/// Makes the engine; `scene` must outlive it. Throws InputError when `leaf_m` is negative or so
/// small that the scene is more than 2^30 leaves long.
std::unique_ptr<OctreeEngine> make_octree_engine(const Scene& scene, const OctreeOptions& options);

}  // namespace sonarsim
