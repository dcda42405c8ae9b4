#pragma once

#include <array>
#include <vector>

#include "product/object_masks.h"

namespace sonarsim {

/// A corner of pixels: [x, y], from the upper left corner of the picture.
using Corner = std::array<int, 2>;

/// The outlines of the parts of a mask, clockwise along the borders of its pixels, a point at each
/// turn. Pixels that touch at a corner alone are parts of their own; holes have no outline.
std::vector<std::vector<Corner>> mask_outlines(const ObjectMask& mask, int height);

/// One polygon around all of them: from part to part and back it runs along lines of no width.
std::vector<Corner> joined_outline(const std::vector<std::vector<Corner>>& parts);

}  // namespace sonarsim
