#include "gallery/numbers.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace sonarsim {

nlohmann::ordered_json short_number(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 5);
    double rounded = 0.0;
    std::from_chars(text, end.ptr, rounded);
    constexpr double largest_whole = 1e15;
    if (std::abs(rounded) < largest_whole && rounded == std::trunc(rounded))
        return static_cast<std::int64_t>(rounded);  // takes less space: 64, not 64.0
    return rounded;
}

}  // namespace sonarsim
