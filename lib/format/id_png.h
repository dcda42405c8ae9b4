#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

// PNG files of pictures with large areas of one value, such as ids: each row is stored as its
// difference from the one above, and what is written is little more than the edges. Their bytes
// depend on the pixels alone.

/// 16 bits, grey. [height, width] ids, row by row.
std::string id_png_bytes(std::span<const std::uint16_t> ids, int width, int height);

using Colour = std::array<std::uint8_t, 3>;

/// 8 bits with a colour table of at most 256 entries.
std::string palette_png_bytes(std::span<const std::uint8_t> indices, int width, int height,
                              std::span<const Colour> table);

/// More than such a file takes.
double id_png_bytes_at_most(int width, int height, int bytes_per_pixel);

/// The colour of an id in the usual colour table for segmentations, that of PASCAL VOC: 0 is black.
Colour colour_of(std::uint32_t id);

}  // namespace sonarsim
