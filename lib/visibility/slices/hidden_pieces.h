#pragma once

#include <cstdint>
#include <vector>

#include "visibility/slices/setup.h"

namespace sonarsim {

/// Where a gap between two slices holds pieces of the scene that no slice of the frame meets: a
/// wire, a small ball.
struct HiddenPlace {
    std::uint32_t gap;
    Extent u;
};

/// In the order of the gaps; pieces that overlap as one. Enters the extents of the pieces into
/// `scene`.
std::vector<HiddenPlace> find_hidden_pieces(const ClusterMesh& mesh, const SliceSetup& setup,
                                            SliceScene& scene);

}  // namespace sonarsim
