#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace sonarsim {

/// The number at offset `at`, little-endian like this processor. Throws std::runtime_error beyond
/// the end.
template <class T>
T field_at(std::string_view bytes, std::size_t at) {
    if (at > bytes.size() || bytes.size() - at < sizeof(T)) throw std::runtime_error("is cut off");
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// The same for either byte order.
template <class T>
T field_at(std::string_view bytes, std::size_t at, bool is_big_endian) {
    auto own = std::bit_cast<std::array<char, sizeof(T)>>(field_at<T>(bytes, at));
    if (is_big_endian) std::reverse(own.begin(), own.end());
    return std::bit_cast<T>(own);
}

}  // namespace sonarsim
