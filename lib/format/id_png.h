#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/rgb.h"

namespace sonarsim {

// PNG files of pictures with large areas of one value, such as ids. Each row is stored as its
// difference from the row above, so that only the edges of areas take space. The bytes depend on
// the pixels alone.

/// A grey PNG file of 16 bits of [height, width] ids, row by row.
std::string id_png_bytes(std::span<const std::uint16_t> ids, int width, int height);

/// A PNG file of 8 bits with a colour table of at most 256 entries.
std::string palette_png_bytes(std::span<const std::uint8_t> indices, int width, int height,
                              std::span<const Rgb> table);

/// The colour of an id in PASCAL VOC's colour table for segmentations: 0 is black.
Rgb colour_of(std::uint32_t id);

}  // namespace sonarsim
