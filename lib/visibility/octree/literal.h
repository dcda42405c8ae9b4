#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/octree/search.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

/// The paper to the letter, as the baseline of the report: every leaf in view stands for its
/// cube's centre and has one vote. Within each cell of azimuth and elevation the leaves are sorted
/// by range, and the first cluster is kept: a gap of four leaves ends it.
Samples literal_samples(Octree& tree, const Scene& scene, const View& view, const Field& field);

}  // namespace sonarsim
