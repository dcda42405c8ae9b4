#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/leaf_size.h"
#include "visibility/octree/tree.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// The visible parts of the leaves in view.
Samples leaf_samples(Octree& tree, const Caster& caster, const Scene& scene, const View& view,
                     const ViewVolume& volume, const LeafSize& leaf_size);

}  // namespace sonarsim
