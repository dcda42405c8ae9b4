#pragma once

#include <cstdint>
#include <vector>

#include "visibility/slices/setup.h"

namespace sonarsim {

/// A slice that is wanted within a gap.
struct WantedSlice {
    std::uint32_t gap;
    float u;
};

/// Slices through the pieces of the scene that are narrower than a gap: a wire, a small ball. Their
/// facets face all ways, and their brightness is the mean of them; a slice of the frame shows one
/// or none. In order of u.
std::vector<WantedSlice> slices_through_narrow_pieces(const SliceScene& scene,
                                                      const SliceFrame& frame);

}  // namespace sonarsim
