#pragma once

#include <cstdint>
#include <vector>

#include "visibility/slices/setup.h"

namespace sonarsim {

/// A slice that is requested within a gap.
struct RequestedSlice {
    std::uint32_t gap;
    float u;
};

/// Slices through the components of the mesh that are narrower than a gap, such as a wire or a
/// small ball. The echo of such a component is the mean over facets of all orientations, but a
/// slice of the frame meets one facet or none. In order of u.
std::vector<RequestedSlice> slices_through_narrow_components(const SliceScene& scene,
                                                             const SliceFrame& frame);

}  // namespace sonarsim
