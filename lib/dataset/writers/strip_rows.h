#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "dataset/averaged_rows.h"
#include "dataset/writer.h"

namespace sonarsim {

/// Visits the rows of a strip from the top. A row is a ping or, in an upright strip, one of the
/// values over all pings. `read` returns the values of ping k; an upright strip reads each ping
/// again for every block of values that fits into memory.
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

/// The bytes of a picture with a pixel for each value of each row of pings, at most.
inline double strip_bytes_at_most(const WriterContext& context, int bytes_per_pixel) {
    const RecordShape& shape = context.kind().record;
    const auto values = static_cast<int>(shape.values(context.sonar().config));
    const int rows = picture_rows(context.pings);
    return shape.upright ? png_bytes_at_most(rows, values, bytes_per_pixel)
                         : png_bytes_at_most(values, rows, bytes_per_pixel);
}

}  // namespace sonarsim
