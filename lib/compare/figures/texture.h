#pragma once

#include <array>
#include <span>

#include "compare/figures/patches.h"

namespace sonarsim {

/// The number of local binary patterns of eight neighbours with at most two changes around the
/// circle, 58, and one for all others (Ojala, Pietikainen and Maenpaa 2002).
inline constexpr int texture_patterns = 59;

/// The number of times that each pattern occurs among the inner pixels of a patch of the image:
/// a bit for each neighbour whose power is at least that of the pixel. Patterns are in the order of
/// their bits, the others last.
std::array<double, texture_patterns> texture_histogram(const ImageView& image,
                                                       const PatchGrid& grid, int place);

}  // namespace sonarsim
