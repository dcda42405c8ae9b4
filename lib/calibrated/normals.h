#pragma once

#include <cstdint>

#include "calibrated/fourier.h"
#include "core/elementary.h"

namespace sonarsim {

/// A complex normal number, either part of variance 1, by each of 8 random words; by Box and
/// Muller: 20 bits make the radius, 12 the angle. The greatest radius is 5.4.
inline void complex_normals(const std::uint32_t* words, Lanes& re, Lanes& im) {
    for (int lane = 0; lane < lanes_at_once; ++lane) {
        const auto upper = static_cast<float>(static_cast<std::int32_t>(words[lane] >> 12));
        const auto lower = static_cast<float>(static_cast<std::int32_t>(words[lane] & 0xFFFU));
        const float radius = std::sqrt(-2.0F * natural_log((upper + 0.5F) * 0x1p-20F));
        const SinCosFloat angle =
            sincos_small(static_cast<float>(2.0 * pi) * ((lower + 0.5F) * 0x1p-12F - 0.5F));
        re[lane] = radius * angle.cos;
        im[lane] = radius * angle.sin;
    }
}

}  // namespace sonarsim
