#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sonarsim {

/// The bytes that a number of an instrument with these bits takes in a file.
inline int raw_bytes(int bits) {
    return bits > 8 ? 2 : 1;
}

/// Numbers of at most 8 bits in bytes.
inline std::vector<std::uint8_t> as_bytes(const std::vector<std::uint16_t>& values) {
    std::vector<std::uint8_t> bytes(values.size());
    std::ranges::transform(values, bytes.begin(),
                           [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
    return bytes;
}

}  // namespace sonarsim
