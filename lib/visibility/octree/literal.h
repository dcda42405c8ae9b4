#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/leaf_size.h"
#include "visibility/octree/tree.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// The paper to the letter, as the baseline of the report: every leaf in view stands for its
/// cube's centre and has one vote. In every direction, a pixel of azimuth and elevation, the leaves
/// are sorted by range and the first cluster is kept, which a gap of four leaves ends.
Samples literal_samples(Octree& tree, const Scene& scene, const View& view,
                        const ViewVolume& volume, const LeafSize& leaf_size);

}  // namespace sonarsim
