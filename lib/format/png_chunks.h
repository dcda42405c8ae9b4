#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

// The parts of a PNG file: www.w3.org/TR/png.

inline constexpr std::string_view png_signature{"\x89PNG\r\n\x1a\n", 8};

/// Appends a chunk: the length of its data, its kind of four letters, the data and their CRC.
void append_png_chunk(std::string& out, std::string_view kind, std::string_view data);

/// The data of an IHDR chunk. `colours`: 0 is grey, 2 RGB.
std::string png_header(int width, int height, int bits, int colours);

}  // namespace sonarsim
