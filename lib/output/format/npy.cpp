#include "output/format/npy.h"

#include <bit>

namespace sonarsim {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the data are written as they are in memory");

constexpr std::size_t alignment = 64;
constexpr std::size_t preamble = 10;  // magic, version, length of the header

}  // namespace

std::string npy_header(const NpyFormat& format) {
    std::string text = "{'descr': '" + format.type +
                       "', 'fortran_order': " + (format.fortran_order ? "True" : "False") +
                       ", 'shape': (";
    for (const std::size_t length : format.shape)
        text += std::to_string(length) + ", ";
    text.resize(text.size() - 2);
    text += "), }";
    const std::size_t used = preamble + text.size() + 1;
    text.append((alignment - used % alignment) % alignment, ' ');
    text += '\n';
    std::string out("\x93NUMPY\x01\x00", 8);
    out += static_cast<char>(text.size() & 0xff);
    out += static_cast<char>(text.size() >> 8);
    return out + text;
}

std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns) {
    std::string bytes = npy_header({"<f4", {rows, columns}});
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return bytes;
}

}  // namespace sonarsim
