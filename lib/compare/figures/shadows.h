#pragma once

#include <vector>

#include "compare/figures/patches.h"
#include "compare/figures/zones.h"

namespace sonarsim {

/// A shadow in one column of a side-scan image: at least 5 ranges whose power, the mean of 5 ranges
/// and 5 columns, lies 6 dB below the median of its range over all columns. Speckle alone makes
/// such a run in fewer than one of 10,000 bins.
struct Shadow {
    int column = 0;
    int from = 0, to = 0;   ///< ranges [from, to)
    double depth_db = 0.0;  ///< level of its middle over the median of the same ranges
    /// Width of the far edge, from a quarter to three quarters of the rise; NaN for one that leaves
    /// the zone.
    double edge_ranges = 0.0;
};

/// The shadows within a zone.
std::vector<Shadow> shadows_of(const ImageView& image, RangeZone zone);

}  // namespace sonarsim
