#pragma once

#include "scene/scene.h"
#include "surface/octree_search.h"
#include "surface/octree_tree.h"
#include "surface/surface.h"

namespace sonarsim {

/// Fills `samples` with the visible parts of the leaves in the field of view.
void look_at_leaves(Octree& tree, const Scene& scene, const View& view, const Field& field,
                    Samples& samples);

}  // namespace sonarsim
