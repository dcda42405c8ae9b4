#pragma once

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

/// ln Gamma(a) of a > 0, by Stirling's series at a + 10.
inline double log_gamma(double a) {
    double product = 1.0;
    for (int n = 0; n < 10; ++n)
        product *= a + n;
    const double b = a + 10.0;
    const double series =
        1.0 / (12.0 * b) - 1.0 / (360.0 * b * b * b) + 1.0 / (1260.0 * b * b * b * b * b);
    return (b - 0.5) * logarithm(b) - b + 0.5 * logarithm(2.0 * pi) + series - logarithm(product);
}

}  // namespace sonarsim
