#include "format/exr_shape.h"

#include <array>
#include <bit>
#include <stdexcept>
#include <string>

namespace sonarsim {

namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers are read as they are in the file");

constexpr std::size_t longest_name = 255;
constexpr std::int32_t longest_attribute = 1 << 20;
constexpr std::int64_t most_pixels_of_side = std::int64_t{1} << 20;

template <class T>
T take(std::istream& file) {
    T value{};
    if (!file.read(reinterpret_cast<char*>(&value), sizeof value))
        throw std::runtime_error("is cut off");
    return value;
}

std::string take_text(std::istream& file) {
    std::string text;
    for (char c = take<char>(file); c != '\0'; c = take<char>(file)) {
        if (text.size() == longest_name) throw std::runtime_error("has a damaged header");
        text += c;
    }
    return text;
}

struct ExrHeader {
    std::array<std::int32_t, 4> window{};  ///< first column and row, last column and row
    bool has_window = false;
    bool compressed = true;
};

ExrHeader take_header(std::istream& file) {
    constexpr std::uint32_t magic = 20000630;
    constexpr std::uint32_t version_of_rows = 2;  // no tiles, no deep pixels, one part
    if (take<std::uint32_t>(file) != magic) throw std::runtime_error("is no OpenEXR file");
    if (take<std::uint32_t>(file) != version_of_rows)
        throw std::runtime_error("is an OpenEXR file of a kind that sonarsim does not write");
    ExrHeader header;
    for (std::string name = take_text(file); !name.empty(); name = take_text(file)) {
        take_text(file);  // its type
        const auto size = take<std::int32_t>(file);
        if (size < 0 || size > longest_attribute) throw std::runtime_error("has a damaged header");
        std::string value(static_cast<std::size_t>(size), '\0');
        if (!file.read(value.data(), size)) throw std::runtime_error("is cut off");
        if (name == "dataWindow" && value.size() == sizeof header.window) {
            value.copy(reinterpret_cast<char*>(header.window.data()), value.size());
            header.has_window = true;
        }
        if (name == "compression") header.compressed = value != std::string(1, '\0');
    }
    return header;
}

}  // namespace

ExrShape exr_shape(std::istream& file, std::uint64_t bytes) {
    const ExrHeader header = take_header(file);
    const std::int64_t columns = std::int64_t{header.window[2]} - header.window[0] + 1;
    const std::int64_t rows = std::int64_t{header.window[3]} - header.window[1] + 1;
    if (!header.has_window || rows < 1 || columns < 1 || rows > most_pixels_of_side ||
        columns > most_pixels_of_side)
        throw std::runtime_error("has no rows or columns");
    if (header.compressed) throw std::runtime_error("is compressed, which sonarsim does not do");
    // The offsets of the rows; a row begins with its number and its size.
    file.seekg(8 * (rows - 1), std::ios::cur);
    const auto last = take<std::uint64_t>(file);
    if (last >= bytes) throw std::runtime_error("is cut off");
    file.seekg(static_cast<std::streamoff>(last + sizeof(std::int32_t)));
    const auto size = take<std::int32_t>(file);
    if (size < 0 || last + 8 + static_cast<std::uint64_t>(size) != bytes)
        throw std::runtime_error("does not end after its last row");
    return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
}

}  // namespace sonarsim
