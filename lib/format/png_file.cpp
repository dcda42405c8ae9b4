#include "format/png_file.h"

#include <zlib.h>

#include <stdexcept>

namespace sonarsim {

namespace {

/// Appends a number with the highest byte first.
void append_number(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(value >> shift & 0xFF);
}

}  // namespace

void append_png_chunk(std::string& out, std::string_view kind, std::string_view data) {
    append_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out.append(kind).append(data);
    const auto* const summed = reinterpret_cast<const unsigned char*>(out.data() + begin);
    append_number(out, static_cast<std::uint32_t>(
                           ::crc32_z(::crc32_z(0, nullptr, 0), summed, out.size() - begin)));
}

std::string png_start(const PngHeader& header) {
    std::string data;
    append_number(data, static_cast<std::uint32_t>(header.width));
    append_number(data, static_cast<std::uint32_t>(header.height));
    data += static_cast<char>(header.bits);
    data += static_cast<char>(header.colours);
    data.append(3, '\0');
    std::string out(png_signature);
    append_png_chunk(out, "IHDR", data);
    return out;
}

std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table) {
    std::string out;
    out.reserve(packed.size() + table.size() + 128);
    out += png_start(header);
    if (!table.empty()) append_png_chunk(out, "PLTE", table);
    append_png_chunk(out, "IDAT", packed);
    append_png_chunk(out, "IEND", {});
    return out;
}

void check_image_size(std::size_t values, int width, int height, int channels) {
    if (values == static_cast<std::size_t>(width) * height * channels) return;
    throw std::logic_error("the number of pixels does not suit the size of the image");
}

}  // namespace sonarsim
