#pragma once

#include <limits>

#include "simulate/visibility/view.h"

namespace sonarsim {

/// Limits on samples that keep a view's image within its error goal.
struct PatchLimits {
    float sag_m;       ///< largest deviation of a patch's range from the linear one
    float shortest_m;  ///< no patch is cut shorter
    /// Largest difference in range span between the two sides of a patch that joins two strips.
    float max_wedge_m;
    /// The same between the two sides of a long patch of grazing surface, whose area in its last
    /// bin counts.
    float grazing_wedge_m;
    float long_grazing_m;  ///< shorter patches may have any wedge
    float range_max_m;     ///< greatest range of interest
    /// Largest ratio of a patch's widths at its two ends, since a parallelogram is equally wide at
    /// both.
    float widest_ratio = std::numeric_limits<float>::infinity();
};

PatchLimits patch_limits(const View& view);

/// The number of slices for an error goal.
struct SliceDensity {
    int per_beam;       ///< before gaps are split
    double difference;  ///< neighbours are split until they differ by at most this share
};

SliceDensity slice_density(const View& view);

}  // namespace sonarsim
