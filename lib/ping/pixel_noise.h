#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"

namespace sonarsim {

/// [10-13] for images of one shape.
struct PixelNoise {
    float gain = 0.5F;               ///< m: 0.5 for imaging and profiling as printed in [12]
    float add_sigma = 0.0F;          ///< Rayleigh scale [11]
    float mult_sigma = 0.0F;         ///< standard deviation of the Gaussian [13]
    std::vector<float> range_scale;  ///< per row: (r / range_max)^2, or 1 [10]
    std::vector<float> lobe_scale;   ///< per column: 1 + 0.5 exp(-phi^2 / (2 sigma^2)), or 1
};

/// I'' = I (m + w_m) + s w_a for every pixel of `image` [rows, columns]. Negative results become
/// 0; returns how many did. What a pixel draws depends on the key, its row and its column alone.
std::uint64_t add_pixel_noise(std::span<float> image, const PixelNoise& noise, PhiloxKey key);

}  // namespace sonarsim
