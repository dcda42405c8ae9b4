#pragma once

#include <cstdint>

namespace sonarsim {

/// The name of a cell of a lattice in its random draws: the lowest 21 bits of its x and y and 22 of
/// its z. Cells that lie 2^21 edges apart share draws, 42 km at 2 cm.
struct CellName {
    std::uint32_t low, high;
};

inline CellName cell_name(std::int32_t x, std::int32_t y, std::int32_t z) {
    constexpr std::uint32_t bits_21 = 0x1FFFFF;
    const auto split = static_cast<std::uint32_t>(z);
    return {.low = (static_cast<std::uint32_t>(x) & bits_21) | split << 21,
            .high = (static_cast<std::uint32_t>(y) & bits_21) | split >> 11 << 21};
}

}  // namespace sonarsim
