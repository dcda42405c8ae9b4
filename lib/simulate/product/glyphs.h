#pragma once

#include <array>
#include <cstdint>

namespace sonarsim {

// A font of capitals, digits and a few signs on a 5 x 7 grid, for labels in raster images.

inline constexpr int glyph_columns = 5;
inline constexpr int glyph_rows = 7;
inline constexpr int glyph_step = 6;  ///< distance between letters, pixels

/// Rows from top to bottom; bit 4 of a row is the leftmost pixel.
using Glyph = std::array<std::uint8_t, glyph_rows>;

/// The glyph of a letter; blank if the font lacks it. Small letters are drawn as capitals.
const Glyph& glyph_of(char letter);

}  // namespace sonarsim
