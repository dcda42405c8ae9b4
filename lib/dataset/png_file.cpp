#include "dataset/png_file.h"

#include <zlib.h>

namespace sonarsim {

namespace {

void add_number(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(value >> shift & 0xFF);
}

void add_chunk(std::string& out, std::string_view kind, std::string_view data) {
    add_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out.append(kind).append(data);
    const auto* const summed = reinterpret_cast<const unsigned char*>(out.data() + begin);
    add_number(out, static_cast<std::uint32_t>(
                        ::crc32_z(::crc32_z(0, nullptr, 0), summed, out.size() - begin)));
}

}  // namespace

std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table) {
    std::string fields;
    add_number(fields, static_cast<std::uint32_t>(header.width));
    add_number(fields, static_cast<std::uint32_t>(header.height));
    fields += static_cast<char>(header.bits);
    fields += static_cast<char>(header.colours);
    fields.append(3, '\0');
    std::string out;
    out.reserve(packed.size() + table.size() + 128);
    out += "\x89PNG\r\n\x1a\n";
    add_chunk(out, "IHDR", fields);
    if (!table.empty()) add_chunk(out, "PLTE", table);
    add_chunk(out, "IDAT", packed);
    add_chunk(out, "IEND", {});
    return out;
}

}  // namespace sonarsim
