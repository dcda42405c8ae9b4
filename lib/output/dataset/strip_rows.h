#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace sonarsim {

/// The most rows (or columns) of a picture of pings; a PNG cannot have many more.
inline constexpr std::size_t max_picture_rows = 60'000;

/// The number of pings that share a row.
inline std::size_t pings_per_row(std::size_t pings) {
    return std::max<std::size_t>(1, (pings + max_picture_rows - 1) / max_picture_rows);
}

/// The number of rows.
inline int picture_rows(std::size_t pings) {
    const std::size_t each = pings_per_row(pings);
    return static_cast<int>((pings + each - 1) / each);
}

/// Visits the rows of a strip from the top: a ping or, if upright, a value over all pings. `read`
/// returns the values of ping k, again for every block of upright rows that fits into memory.
template <class T, class Read, class Visit>
void for_each_strip_row(std::size_t pings, std::size_t values, bool upright, const Read& read,
                        const Visit& visit) {
    if (!upright) {
        for (std::size_t k = 0; k < pings; ++k)
            visit(std::span<const T>(read(k)));
        return;
    }
    constexpr std::size_t block_values = std::size_t{1} << 24;
    const std::size_t at_once = std::clamp<std::size_t>(block_values / pings, 1, values);
    std::vector<T> block(at_once * pings);
    for (std::size_t first = 0; first < values; first += at_once) {
        const std::size_t count = std::min(at_once, values - first);
        for (std::size_t k = 0; k < pings; ++k) {
            const std::vector<T>& ping = read(k);
            for (std::size_t i = 0; i < count; ++i)
                block[i * pings + k] = ping[first + i];
        }
        for (std::size_t i = 0; i < count; ++i)
            visit(std::span<const T>(block).subspan(i * pings, pings));
    }
}

}  // namespace sonarsim
