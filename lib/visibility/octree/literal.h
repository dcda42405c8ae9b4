#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/leaf_size.h"
#include "visibility/octree/tree.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// The paper's method without changes, as the baseline of the report: every leaf in view is
/// represented by its cube's centre and has one vote. In every direction, a pixel of azimuth and
/// elevation, the leaves are sorted by range, and the first cluster up to a gap of four leaves is
/// kept.
Samples literal_samples(Octree& tree, const Scene& scene, const View& view,
                        const ViewVolume& volume, const LeafSize& leaf_size);

}  // namespace sonarsim
