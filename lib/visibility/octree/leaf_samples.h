#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/search.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

/// The visible parts of the leaves in the field of view.
Samples leaf_samples(Octree& tree, const Scene& scene, const View& view, const Field& field);

}  // namespace sonarsim
