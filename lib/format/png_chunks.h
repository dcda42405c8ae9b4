#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sonarsim {

// The parts of a PNG file: www.w3.org/TR/png.

// Filters of a row: none, and the difference of each byte from the pixel to the left, and above.
inline constexpr std::uint8_t png_filter_none = 0;
inline constexpr std::uint8_t png_filter_left = 1;
inline constexpr std::uint8_t png_filter_up = 2;

inline constexpr std::string_view png_signature{"\x89PNG\r\n\x1a\n", 8};

/// Appends a chunk: the length of its data, its kind of four letters, the data and their CRC.
void append_png_chunk(std::string& out, std::string_view kind, std::string_view data);

/// The data of an IHDR chunk. `colours` is 0 for grey, 2 for RGB, 3 for a colour table.
std::string png_header(int width, int height, int bits, int colours);

}  // namespace sonarsim
