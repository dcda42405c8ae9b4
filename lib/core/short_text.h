#pragma once

#include <array>
#include <charconv>
#include <string>

#include "core/text.h"

namespace sonarsim {

/// A few digits and no exponent, as people write a share or a percentage: "0.026", "3", "120".
inline std::string short_text(double value, int digits = 2) {
    std::array<char, 32> buffer{};
    const auto rounded = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                       std::chars_format::scientific, digits - 1);
    return number_text(*parse_number({buffer.data(), rounded.ptr}));
}

}  // namespace sonarsim
