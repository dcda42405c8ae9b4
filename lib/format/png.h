#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// An image as a PNG file in memory: [height, width, channels], 8 bits per value; 1 channel is
/// grey, 3 are RGB. The bytes depend on the pixels alone: nothing is stamped. Throws
/// std::runtime_error when the encoder fails.
std::string png_bytes(std::span<const std::uint8_t> pixels, int width, int height,
                      int channels = 1);

/// The same with 16 bits per value, grey.
std::string png_bytes(std::span<const std::uint16_t> pixels, int width, int height);

/// More than such a file takes when nothing in it can be compressed: a filter byte per row, and the
/// blocks and chunks of the format.
double png_bytes_at_most(int width, int height, int bytes_per_pixel);

/// What compresses, and the version of the library that does so for products: another one stores
/// the same pixels in other bytes.
std::string png_encoder();

}  // namespace sonarsim
