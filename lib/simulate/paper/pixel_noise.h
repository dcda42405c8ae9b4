#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"

namespace sonarsim {

/// The pixel noise of one sonar, Eq. 10-13.
struct PixelNoise {
    float gain = 0.5F;               ///< m of Eq. 12: 0.5, as printed, for imaging and profiling
    float add_sigma = 0.0F;          ///< sigma_a, scale of the Rayleigh distribution, Eq. 11
    float mult_sigma = 0.0F;         ///< sigma_m, standard deviation of the Gaussian, Eq. 13
    std::vector<float> range_scale;  ///< per row: (r / range_max)^2 of Eq. 10, or 1
    std::vector<float> lobe_scale;   ///< per column: 1 + 0.5 exp(-phi^2 / (2 sigma^2)), or 1
};

/// I'' = I (m + w_m) + s w_a, Eq. 12, for every pixel of `image` [rows, columns], where s is the
/// product of its two scales. Negative results become 0; returns their number. The draws of a pixel
/// depend on the key, its row and its column alone.
std::uint64_t add_pixel_noise(std::span<float> image, const PixelNoise& noise, PhiloxKey key);

}  // namespace sonarsim
