#pragma once

#include <algorithm>
#include <cmath>

namespace sonarsim {

/// The bins [i, i + 1), i from 0 to count - 1, that an interval overlaps. All lengths are in bins.
template <class Real>
struct OverlappedBins {
    Real from, to;  ///< the interval, clipped to the bins
    int begin = 0;  ///< the first bin
    int end = 0;    ///< one behind the last bin; equal to `begin` if there is none

    OverlappedBins(Real low, Real high, int count)
        : from(std::max(low, Real(0))), to(std::min(high, static_cast<Real>(count))) {
        if (!(from < to)) return;
        begin = static_cast<int>(from);
        end = std::min(static_cast<int>(std::ceil(to)), count);
    }

    bool empty() const { return begin == end; }
    Real overlap(int i) const {
        return std::min(to, static_cast<Real>(i + 1)) - std::max(from, static_cast<Real>(i));
    }
};

}  // namespace sonarsim
