#pragma once

#include <cstddef>
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

/// The colour types of PNG.
enum class PngColours : std::uint8_t { grey = 0, rgb = 2, table = 3 };

struct PngHeader {
    int width = 0;
    int height = 0;
    int bits = 8;  ///< per value
    PngColours colours = PngColours::grey;
};

/// Appends a chunk: the length of its data, its kind of four letters, the data and their CRC.
void append_png_chunk(std::string& out, std::string_view kind, std::string_view data);

/// The signature and the IHDR chunk.
std::string png_start(const PngHeader& header);

/// Makes a PNG file. `packed` is the zlib stream of the filtered rows; `table` has three bytes for
/// each colour of PngColours::table.
std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table = {});

/// std::logic_error unless an image of this size has `values` values.
void check_image_size(std::size_t values, int width, int height, int channels);

}  // namespace sonarsim
