#include "exr_header.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace {

static_assert(std::endian::native == std::endian::little, "as the numbers of the file are");

std::uint32_t read_number(std::istream& in) {
    std::uint32_t number = 0;
    in.read(reinterpret_cast<char*>(&number), sizeof number);
    return number;
}

/// The length of a text that ends with a zero. A longer one than the format allows fails the
/// stream.
std::streamsize skip_text(std::istream& in) {
    char text[257];
    in.getline(text, std::size(text), '\0');
    return in.gcount() - 1;
}

/// Skips a list of attributes (name, type, size, value). Returns how many it has.
int skip_attributes(std::istream& in, std::uint64_t file_bytes) {
    int count = 0;
    for (; in && skip_text(in) > 0; ++count) {
        skip_text(in);
        const std::uint32_t bytes = read_number(in);
        const auto position = in.tellg();
        if (position < 0 || bytes > file_bytes - static_cast<std::uint64_t>(position))
            in.setstate(std::ios::failbit);
        else
            in.seekg(bytes, std::ios::cur);
    }
    return count;
}

}  // namespace

void check_exr_header(const char* file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const auto file_bytes = static_cast<std::uint64_t>(in.tellg());
    in.seekg(4);
    constexpr std::uint32_t has_parts = 0x1000;
    const bool is_one_part = (read_number(in) & has_parts) == 0;
    // An empty list follows the lists of several parts.
    while (in && skip_attributes(in, file_bytes) > 0 && !is_one_part) {
    }
    if (!in) throw std::runtime_error("its header is damaged: copy or export it again");
}
