#pragma once

#include <doctest/doctest.h>

#include <limits>

namespace sonarsim::test {

/// doctest's Approx with a relative tolerance at every scale: |a - b| < epsilon max(|a|, |b|).
/// doctest adds 1 to the maximum, so that its Approx(1e-8) equals 0.
inline doctest::Approx approx(double value) {
    return doctest::Approx(value).scale(std::numeric_limits<double>::min());
}

}  // namespace sonarsim::test
