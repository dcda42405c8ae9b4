#pragma once

#include <cmath>
#include <cstdint>

#include "core/elementary.h"

namespace sonarsim {

/// Two independent draws of normal(0, 1).
struct NormalPair {
    float first, second;
};

/// Two draws from one random word, by Box and Muller: 20 bits make the radius, 12 the angle. The
/// greatest radius is 5.4; one draw in 15 million would lie beyond.
inline NormalPair normal_pair(std::uint32_t word) {
    const auto upper = static_cast<float>(static_cast<std::int32_t>(word >> 12));
    const auto lower = static_cast<float>(static_cast<std::int32_t>(word & 0xFFFU));
    const float radius = std::sqrt(-2.0F * natural_log((upper + 0.5F) * 0x1p-20F));
    const SinCosFloat angle =
        sincos_small(static_cast<float>(2.0 * pi) * ((lower + 0.5F) * 0x1p-12F - 0.5F));
    return {radius * angle.cos, radius * angle.sin};
}

}  // namespace sonarsim
