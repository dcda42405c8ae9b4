#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/search.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

/// Fills `samples` with the visible parts of the leaves in the field of view.
void look_at_leaves(Octree& tree, const Scene& scene, const View& view, const Field& field,
                    Samples& samples);

}  // namespace sonarsim
