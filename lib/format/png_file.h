#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sonarsim {

// PNG: www.w3.org/TR/png.

/// What the numbers of a pixel are.
enum class PngColours : std::uint8_t { grey = 0, rgb = 2, table = 3 };

struct PngHeader {
    int width = 0;
    int height = 0;
    int bits = 8;  ///< of a number
    PngColours colours = PngColours::grey;
};

/// A PNG file around `packed`, the rows with their filters as a zlib stream. `table`: three bytes
/// for each colour of PngColours::table.
std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table = {});

}  // namespace sonarsim
