#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sonarsim::test {

template <class T>
std::string exr_bytes(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// An OpenEXR file of one channel, whose numbers have 4 bytes (floats) or 2 (halves), row by row
/// and not compressed. After its 8 bytes of magic number and version come attributes (name, type,
/// size, value), a 0, the offset of every row, and the rows (number, size, values).
inline std::string exr_of(const std::string& numbers, int bytes_each, int width, int height) {
    const auto attribute = [](const std::string& name, const std::string& type,
                              const std::string& value) {
        return name + '\0' + type + '\0' + exr_bytes(static_cast<std::int32_t>(value.size())) +
               value;
    };
    const auto box = [&] {
        std::string out;
        for (const int x : {0, 0, width - 1, height - 1})
            out += exr_bytes(x);
        return out;
    };
    std::string channels =
        std::string("Y\0", 2) + exr_bytes(bytes_each == 2 ? 1 : 2) + std::string(4, '\0');
    channels += exr_bytes(1) + exr_bytes(1) + '\0';
    std::string out("\x76\x2f\x31\x01\x02\0\0\0", 8);
    out += attribute("channels", "chlist", channels);
    out += attribute("compression", "compression", std::string(1, '\0'));
    out += attribute("dataWindow", "box2i", box());
    out += attribute("displayWindow", "box2i", box());
    out += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    out += attribute("pixelAspectRatio", "float", exr_bytes(1.0F));
    out += attribute("screenWindowCenter", "v2f", exr_bytes(0.0F) + exr_bytes(0.0F));
    out += attribute("screenWindowWidth", "float", exr_bytes(1.0F)) + '\0';
    const std::size_t row_values =
        static_cast<std::size_t>(bytes_each) * static_cast<std::size_t>(width);
    const std::size_t row_bytes = 8 + row_values;
    const std::size_t first = out.size() + 8 * static_cast<std::size_t>(height);
    for (int row = 0; row < height; ++row)
        out += exr_bytes(
            static_cast<std::uint64_t>(first + static_cast<std::size_t>(row) * row_bytes));
    for (int row = 0; row < height; ++row) {
        out += exr_bytes(row) + exr_bytes(bytes_each * width) +
               numbers.substr(static_cast<std::size_t>(row) * row_values, row_values);
    }
    return out;
}

}  // namespace sonarsim::test
