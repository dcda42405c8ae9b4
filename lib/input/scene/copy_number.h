#pragma once

#include <string>

namespace sonarsim {

/// A name without the number that Blender adds to the name of a copy, a point and three or more
/// digits: "Mine" for "Mine.001".
inline std::string without_copy_number(const std::string& name) {
    constexpr std::size_t min_digits = 3;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot == 0 || name.size() - dot - 1 < min_digits) return name;
    const bool digits = name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
    return digits ? name.substr(0, dot) : name;
}

}  // namespace sonarsim
