#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

// PNG files of pictures with large areas of one value, such as ids. Each row is stored as its
// difference from the row above, so that only the edges of areas take space. The bytes depend on
// the pixels alone.

/// A grey PNG file of 16 bits of [height, width] ids, row by row.
std::string id_png_bytes(std::span<const std::uint16_t> ids, int width, int height);

}  // namespace sonarsim
