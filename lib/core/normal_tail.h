#pragma once

#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

inline double normal_density(double x) {
    return exponential(-0.5 * x * x) / std::sqrt(2.0 * pi);
}

/// The probability of a normal number above x >= 0, within 1e-7 (Abramowitz and Stegun 26.2.17).
inline double normal_tail(double x) {
    const double t = 1.0 / (1.0 + 0.2316419 * x);
    const double series =
        t * (0.319381530 +
             t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
    return normal_density(x) * series;
}

}  // namespace sonarsim
