#pragma once

#include <cstdint>

#include "calibrated/fourier.h"
#include "core/normals.h"

namespace sonarsim {

/// A complex normal number for each of 8 random words; either part has variance 1.
inline void complex_normals(const std::uint32_t* words, Lanes& re, Lanes& im) {
    for (int lane = 0; lane < lanes_at_once; ++lane) {
        const NormalPair pair = normal_pair(words[lane]);
        re[lane] = pair.first;
        im[lane] = pair.second;
    }
}

}  // namespace sonarsim
