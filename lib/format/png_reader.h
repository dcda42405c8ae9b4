#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <span>

namespace sonarsim {

struct PngShape {
    int width = 0;
    int height = 0;
    int bits = 8;      ///< per value, 8 or 16
    int channels = 1;  ///< 3 for RGB; 1 for grey and for the indices of a colour table
};

/// Decodes a PNG image as sonarsim writes it: 8 or 16 bits, grey, RGB or with a colour table, not
/// interlaced. Calls `row` with each row, values of 16 bits with the high byte first, so that an
/// image may be longer than memory. Checks all check sums. `file_bytes`, the length of the file,
/// limits the pixels that it can hold. Throws std::runtime_error with the reason when the file is
/// no such image or is not whole.
PngShape read_png(std::istream& file, std::uint64_t file_bytes,
                  const std::function<void(const PngShape&, std::span<const std::uint8_t>)>& row);

}  // namespace sonarsim
