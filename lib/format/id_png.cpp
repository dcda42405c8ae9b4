#include "format/id_png.h"

#include <cstring>
#include <utility>
#include <vector>

#include "format/deflate.h"
#include "format/png_file.h"

namespace sonarsim {

namespace {

/// [height, width] pixels as the zlib stream of a PNG: `write` puts a row of pixels into bytes, big
/// endian.
template <class Pixel, class Write>
std::string pack_pixels(std::span<const Pixel> pixels, int width, int height, Write write) {
    const auto columns = static_cast<std::size_t>(width);
    check_image_size(pixels.size(), width, height, 1);
    const std::size_t row_bytes = columns * sizeof(Pixel);
    std::vector<std::uint8_t> above(row_bytes, 0);
    std::vector<std::uint8_t> own(row_bytes);
    std::vector<std::uint8_t> rows(height * (row_bytes + 1));
    std::uint8_t* to = rows.data();
    for (int i = 0; i < height; ++i, to += row_bytes) {
        write(pixels.data() + static_cast<std::size_t>(i) * columns, columns, own.data());
        *to++ = png_filter_up;
        for (std::size_t k = 0; k < row_bytes; ++k)
            to[k] = static_cast<std::uint8_t>(own[k] - above[k]);
        std::swap(own, above);
    }
    return zlib_bytes(rows, 1, Packing::runs);
}

}  // namespace

std::string id_png_bytes(std::span<const std::uint16_t> ids, int width, int height) {
    const auto big_endian = [](const std::uint16_t* from, std::size_t count, std::uint8_t* to) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto swapped = static_cast<std::uint16_t>(from[k] << 8 | from[k] >> 8);
            std::memcpy(to + 2 * k, &swapped, 2);
        }
    };
    return png_file({width, height, 16, PngColours::grey},
                    pack_pixels(ids, width, height, big_endian));
}

}  // namespace sonarsim
