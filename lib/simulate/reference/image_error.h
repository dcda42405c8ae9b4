#pragma once

#include <cstdint>
#include <span>

namespace sonarsim {

/// Error of an image A against the truth B; both noise-free and before pixel noise.
struct ImageError {
    double relative_l1 = 0.0;  ///< sum |A - B| / sum B
    double miss_rate = 0.0;    ///< bins occupied only in B, per bin occupied in B
};

/// The error over the bins that `scored` marks with 1; empty: over all. Two dark images have no
/// error; against a dark truth any echo is an error of 1.
ImageError image_error(std::span<const float> image, std::span<const float> truth,
                       std::span<const std::uint8_t> scored = {});

}  // namespace sonarsim
