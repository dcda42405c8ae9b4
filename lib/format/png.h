#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// A PNG file in memory of [height, width, channels] values of 8 bits; 1 channel is grey, 3 are
/// RGB. The bytes depend on the pixels alone.
std::string png_bytes(std::span<const std::uint8_t> pixels, int width, int height,
                      int channels = 1);

/// A grey PNG file in memory of [height, width] values of 16 bits.
std::string png_bytes(std::span<const std::uint16_t> pixels, int width, int height);

/// An upper limit of the size of a PNG file: pixels that do not compress, a filter byte per row, a
/// colour table, and the blocks and chunks of the format.
double png_bytes_at_most(int width, int height, int bytes_per_pixel);

/// Names the way in which pixels are packed. Another way stores the same pixels in other bytes.
std::string png_encoder();

}  // namespace sonarsim
