#include "format/png_chunks.h"

#include <zlib.h>

#include <cstdint>

namespace sonarsim {

namespace {

/// Appends a number with the highest byte first.
void append_png_number(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(value >> shift & 0xFF);
}

}  // namespace

void append_png_chunk(std::string& out, std::string_view kind, std::string_view data) {
    append_png_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out.append(kind).append(data);
    const auto* const summed = reinterpret_cast<const unsigned char*>(out.data() + begin);
    append_png_number(out, static_cast<std::uint32_t>(
                               ::crc32_z(::crc32_z(0, nullptr, 0), summed, out.size() - begin)));
}

std::string png_header(int width, int height, int bits, int colours) {
    std::string header;
    append_png_number(header, static_cast<std::uint32_t>(width));
    append_png_number(header, static_cast<std::uint32_t>(height));
    header += static_cast<char>(bits);
    header += static_cast<char>(colours);
    header.append(3, '\0');
    return header;
}

}  // namespace sonarsim
