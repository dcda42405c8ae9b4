#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace sonarsim::test {

/// Appends numbers as their bytes, little-endian if not stated otherwise.
class MadeBytes {
  public:
    explicit MadeBytes(bool big_endian = false) : is_big_endian_(big_endian) {}

    template <class T>
    MadeBytes& add(T value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        if (is_big_endian_) std::reverse(bytes, bytes + sizeof value);
        text.append(bytes, sizeof value);
        return *this;
    }
    MadeBytes& u16(int value) { return add(static_cast<std::uint16_t>(value)); }
    MadeBytes& u32(std::uint32_t value) { return add(value); }
    MadeBytes& f32(double value) { return add(static_cast<float>(value)); }
    template <class T>
    MadeBytes& at(std::size_t place, T value) {
        std::memcpy(&text[place], &value, sizeof value);
        return *this;
    }

    std::string text;

  private:
    bool is_big_endian_;
};

}  // namespace sonarsim::test
