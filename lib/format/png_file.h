#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sonarsim {

// PNG: www.w3.org/TR/png.

/// The colour types of PNG.
enum class PngColours : std::uint8_t { grey = 0, rgb = 2, table = 3 };

struct PngHeader {
    int width = 0;
    int height = 0;
    int bits = 8;  ///< per value
    PngColours colours = PngColours::grey;
};

/// Makes a PNG file. `packed` is the zlib stream of the filtered rows; `table` has three bytes for
/// each colour of PngColours::table.
std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table = {});

}  // namespace sonarsim
