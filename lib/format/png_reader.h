#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <span>

namespace sonarsim {

struct PngShape {
    int width = 0;
    int height = 0;
    int bits = 8;      ///< of a value, 8 or 16
    int channels = 1;  ///< 3 for RGB; 1 for grey and for the indices of a colour table
};

/// Decodes a PNG image of 8 or 16 bits, grey, RGB or with a colour table, not interlaced: what
/// sonarsim writes. `row` is handed each row in turn, numbers of 16 bits with the high byte first,
/// so that an image may be longer than memory. Every check sum is checked. `file_bytes`: how long
/// the file is, which limits the pixels that it can hold. std::runtime_error with the reason when
/// the file is no such image or not whole.
PngShape read_png(std::istream& file, std::uint64_t file_bytes,
                  const std::function<void(const PngShape&, std::span<const std::uint8_t>)>& row);

}  // namespace sonarsim
