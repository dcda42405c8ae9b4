#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace sonarsim {

/// The number at a place of bytes, little-endian as this processor. Throws std::runtime_error
/// beyond their end.
template <class T>
T field_at(std::string_view bytes, std::size_t at) {
    if (at > bytes.size() || bytes.size() - at < sizeof(T)) throw std::runtime_error("is cut off");
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

}  // namespace sonarsim
