#pragma once

#include "core/elementary.h"

namespace sonarsim {

inline constexpr double ln_10 = 0x1.26bb1bbb55516p+1;

/// 10^(db / 10): the ratio of two powers.
inline double power_of_db(double db) {
    return exponential(0.1 * db * ln_10);
}

/// 10 log10 of a positive ratio of powers.
inline double db_of_power(double ratio) {
    return 10.0 / ln_10 * logarithm(ratio);
}

}  // namespace sonarsim
