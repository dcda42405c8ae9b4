#include "format/png_file.h"

#include "format/png_chunks.h"

namespace sonarsim {

std::string png_file(const PngHeader& header, std::string_view packed, std::string_view table) {
    std::string out;
    out.reserve(packed.size() + table.size() + 128);
    out += png_signature;
    append_png_chunk(
        out, "IHDR",
        png_header(header.width, header.height, header.bits, static_cast<int>(header.colours)));
    if (!table.empty()) append_png_chunk(out, "PLTE", table);
    append_png_chunk(out, "IDAT", packed);
    append_png_chunk(out, "IEND", {});
    return out;
}

}  // namespace sonarsim
