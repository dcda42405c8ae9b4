#pragma once

#include <algorithm>
#include <cmath>

#include "core/lanes.h"

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

// The least depth of surface, in bins, since areas are divided by depths. The step of a float just
// below 8192 bins is half of this.
inline constexpr float least_depth_bins = 1e-3F;

/// The overlaps of [from, to) and the bins i to i + 7, in bins; 0 where there is none. `to` must
/// not exceed the view. Callers take multiples of 8 as i: a load that overlaps the last store only
/// in part waits for that store.
inline Floats8 overlaps_of_eight(float from, float to, int i) {
    const Floats8 bins = static_cast<float>(i) + to_floats(lane_numbers());
    return greatest(least(to, bins + 1.0F) - greatest(from, bins), 0.0F);
}

}  // namespace sonarsim
