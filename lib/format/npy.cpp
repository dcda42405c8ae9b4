#include "format/npy.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <sstream>
#include <stdexcept>

#include "core/text.h"

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

NpyFormat npy_format(std::string_view start) {
    const std::string text(start.substr(0, start.find('\n')));
    NpyFormat format;
    for (const char* type : {"|u1", "<u2", "<f4", "<f8"}) {
        if (text.find(std::string("'") + type) != std::string::npos) format.type = type;
    }
    format.fortran_order = text.find("'fortran_order': True") != std::string::npos;
    const std::string mark = "'shape': (";
    const std::size_t first = text.find(mark);
    const std::size_t last = text.find(')', std::min(first, text.size()));
    if (first != std::string::npos && last != std::string::npos) {
        std::istringstream lengths(text.substr(first + mark.size(), last - first - mark.size()));
        for (std::string length; std::getline(lengths >> std::ws, length, ',');)
            format.shape.push_back(parse_unsigned(length).value_or(0));
    }
    if (format.type.empty() || format.shape.empty() || !start.starts_with(npy_header(format)))
        throw std::runtime_error("is not a .npy file of format 1.0");
    return format;
}

std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns) {
    const std::string head = npy_header({"<f4", {rows, columns}});
    std::string bytes;
    bytes.reserve(head.size() + values.size_bytes());
    bytes.append(head).append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return bytes;
}

}  // namespace sonarsim
