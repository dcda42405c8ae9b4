#pragma once

#include <cstdint>

#include "calibrated/fourier.h"
#include "core/normal_pair.h"

namespace sonarsim {

/// A complex normal number by each of 8 random words; real and imaginary part have variance 1.
inline void complex_normals(const std::uint32_t* words, Lanes& re, Lanes& im) {
    for (int lane = 0; lane < lanes_at_once; ++lane) {
        const NormalPair draws = normal_pair(words[lane]);
        re[lane] = draws.first;
        im[lane] = draws.second;
    }
}

}  // namespace sonarsim
