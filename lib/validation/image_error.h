#pragma once

#include <span>

namespace sonarsim {

/// Error of an image A against the truth B; both noise-free and before pixel noise.
struct ImageError {
    double relative_l1 = 0.0;  ///< sum |A - B| / sum B
    double relative_l2 = 0.0;  ///< sqrt(sum (A - B)^2 / sum B^2)
    double miss_rate = 0.0;    ///< bins occupied only in B, per bin occupied in B
    double false_rate = 0.0;   ///< bins occupied only in A, per bin occupied in A
};

/// Two dark images have no error; against a dark truth any echo is an error of 1.
ImageError image_error(std::span<const float> image, std::span<const float> truth);

}  // namespace sonarsim
