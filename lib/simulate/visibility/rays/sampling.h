#pragma once

#include "simulate/visibility/view.h"

namespace sonarsim {

/// A column of rays that disagrees with its neighbour is divided into a wide middle strip and two
/// narrow edge strips, each this share of the column's width: in a bin a sliver of surface is as
/// bright as a full view of it, so a silhouette within the column needs rays on both sides.
inline constexpr float edge_strip_share = 0.1F;

/// Rays extend beyond the greatest range by this share of it. Surface there has no echo in range
/// and hides no surface in range, but it shows whether the surface in range continues.
inline constexpr float overreach = 0.01F;

/// The sampling density of the rays engine for a view.
struct Sampling {
    int columns = 1;          ///< number of columns: per beam of a fan, per side, or around a cone
    int rays = 32;            ///< along a column before gaps are split, 2 at least
    float inset = 0.5F;       ///< steps from a column's ends to its first and last ray
    int split_levels = 8;     ///< the most splits of the gap between two neighbouring rays
    int bend_levels = 1;      ///< the fewest splits of a gap in which the surface bends
    bool edge_strips = true;  ///< columns that disagree with a neighbour get edge strips
    float range_uncertainty_m = 0.0F;  ///< gaps with more than this are split
    float tolerance_m = 0.0F;  ///< largest difference of a neighbour's plane from a ray's range
    float tolerance_cosine = 0.1F;  ///< largest relative difference of a cosine between columns

    /// Spacing of the rays of a column that spans `span`, before gaps are split; same unit.
    double step(double span) const { return span / (rays - 1 + 2.0 * inset); }
};

/// The density that meets the view's error goal, fitted to the speed-against-error report.
Sampling sampling_for(const View& view);

}  // namespace sonarsim
