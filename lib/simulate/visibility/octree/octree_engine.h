#pragma once

#include <memory>

#include "input/scene/scene.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

struct OctreeOptions {
    double leaf_m = 0.02;  ///< edge of the leaves
};

/// Makes the paper's octree as printed, the baseline of comparisons: every leaf in view stands for
/// its surface with its cube's centre and one vote. In every pixel of azimuth and elevation the
/// leaves are sorted by range, and the first cluster, which ends at a gap of more than four leaves,
/// hides the others. The tree grows as pings come; a ping does not depend on earlier ones. `scene`
/// must outlive the engine. InputError with too_small_leaves().
std::unique_ptr<VisibilityEngine> make_octree_engine(const Scene& scene,
                                                     const OctreeOptions& options);

}  // namespace sonarsim
