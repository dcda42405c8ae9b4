#pragma once

#include <array>
#include <vector>

#include "product/object_masks.h"

namespace sonarsim {

/// A corner of a pixel, [x, y], counted from the upper left corner of the picture.
using Corner = std::array<int, 2>;

/// The outlines of the parts of a mask, clockwise along the borders of its pixels, with a point at
/// each turn. Pixels that touch only at a corner are separate parts; holes have no outline.
std::vector<std::vector<Corner>> mask_outlines(const ObjectMask& mask, int height);

/// Joins outlines to one polygon, with lines of no width from part to part and back.
std::vector<Corner> joined_outline(const std::vector<std::vector<Corner>>& parts);

}  // namespace sonarsim
