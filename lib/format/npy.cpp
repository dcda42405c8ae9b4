#include "format/npy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace sonarsim {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the data are written as they are in memory");

constexpr std::size_t alignment = 64;
constexpr std::size_t preamble = 10;  // magic, version, length of the header
constexpr std::size_t largest_file = std::size_t{1} << 30;

/// The number in `text` between `mark` and the next `end`; 0 if there is none.
std::size_t number_between(const std::string& text, const std::string& mark, char end) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) return 0;
    const std::size_t first = at + mark.size();
    const std::size_t last = text.find(end, first);
    if (last == std::string::npos) return 0;
    return parse_unsigned(std::string_view(text).substr(first, last - first)).value_or(0);
}

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
        throw std::runtime_error("is no .npy file, format 1.0, as sonarsim writes it");
    return format;
}

std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns) {
    const std::string head = npy_header({"<f4", {rows, columns}});
    std::string bytes;
    bytes.reserve(head.size() + values.size_bytes());
    bytes.append(head).append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return bytes;
}

std::string npy_bytes_of_columns(std::span<const float> by_column, std::size_t rows,
                                 std::size_t columns) {
    std::string bytes = npy_header({"<f4", {rows, columns}});
    const std::size_t head = bytes.size();
    bytes.resize(head + by_column.size_bytes());
    // Tiles fit the first-level cache, and whole cache lines are written.
    constexpr std::size_t tile = 16;
    std::array<float, tile> line;
    for (std::size_t i0 = 0; i0 < rows; i0 += tile) {
        for (std::size_t j0 = 0; j0 < columns; j0 += tile) {
            const std::size_t i1 = std::min(i0 + tile, rows);
            const std::size_t j1 = std::min(j0 + tile, columns);
            for (std::size_t i = i0; i < i1; ++i) {
                for (std::size_t j = j0; j < j1; ++j)
                    line[j - j0] = by_column[j * rows + i];
                std::memcpy(bytes.data() + head + (i * columns + j0) * sizeof(float), line.data(),
                            (j1 - j0) * sizeof(float));
            }
        }
    }
    return bytes;
}

Matrix read_npy(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, largest_file);
    const std::string start = bytes.substr(0, 4 * alignment);
    Matrix matrix;
    matrix.rows = number_between(start, "'shape': (", ',');
    matrix.columns = number_between(start, "'shape': (" + std::to_string(matrix.rows) + ", ", ')');
    const std::string head = npy_header({"<f4", {matrix.rows, matrix.columns}});
    const std::size_t cells = (bytes.size() - std::min(head.size(), bytes.size())) / sizeof(float);
    if (!bytes.starts_with(head) || matrix.columns == 0 || cells / matrix.columns != matrix.rows ||
        bytes.size() != head.size() + matrix.rows * matrix.columns * sizeof(float)) {
        throw InputError({path.string()}, "is not a two-dimensional float32 .npy file, format 1.0");
    }
    matrix.values.resize(matrix.rows * matrix.columns);
    std::memcpy(matrix.values.data(), bytes.data() + head.size(),
                matrix.values.size() * sizeof(float));
    return matrix;
}

}  // namespace sonarsim
