#pragma once

#include <vector>

#include "scene/scene.h"
#include "validation/reference.h"
#include "visibility/view.h"

namespace sonarsim::test {

/// Adds to a reference what its rays missed in bins that `image` fills: the parts of triangles in
/// such a bin are found by halving the triangles' sides, and rays are cast to them. A bin stays
/// dark if none of them is visible. The pose is that of the world frame.
///
/// A bin is as bright for a sliver of surface as for a wall, and slivers get smaller than any
/// number of rays can find. Without this step an image that is right counts as wrong in such bins:
/// on the drawn lattices by 0.5 % of the signal.
void add_slivers(const Scene& scene, const View& view, const std::vector<float>& image,
                 Reference& reference);

}  // namespace sonarsim::test
