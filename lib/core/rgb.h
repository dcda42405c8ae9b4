#pragma once

#include <cstdint>

namespace sonarsim {

struct Rgb {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    bool operator==(const Rgb&) const = default;
};
static_assert(sizeof(Rgb) == 3, "a row of colours is a row of bytes");

}  // namespace sonarsim
