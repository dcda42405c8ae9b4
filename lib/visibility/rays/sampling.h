#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// Where a column of rays disagrees with its neighbour, it is seen as a wide middle strip between
/// two narrow edge strips, each this share of the column's width. A bin is as bright for a sliver
/// of surface as for a full view of it, so a silhouette within the column must have rays on both
/// of its sides: three equal strips miss one silhouette in three, these miss one in ten.
inline constexpr float edge_strip_share = 0.1F;

/// Rays go beyond the greatest range by this share of it. Surface out there neither echoes nor
/// hides any that does, but it shows whether the surface in range continues.
inline constexpr float overreach = 0.01F;

/// How densely the rays engine samples a view.
struct Sampling {
    int columns = 1;          ///< of rays: per beam of a fan, per side, or around a cone
    int rays = 32;            ///< along a column before gaps are split, 2 at least
    float inset = 0.5F;       ///< steps from a column's ends to its first and last ray
    int split_levels = 8;     ///< how often the gap between two neighbouring rays is split at most
    int bend_levels = 1;      ///< how often it is split at least where the surface bends in it
    bool edge_strips = true;  ///< columns that disagree with a neighbour get edge strips
    float range_uncertainty_m = 0.0F;  ///< gaps with more than this are split
    float tolerance_m = 0.0F;          ///< by which a neighbour's plane may miss a ray's range
    float tolerance_cosine = 0.1F;     ///< share by which a cosine may differ between columns

    /// From ray to ray of a column that spans `span`, before gaps are split; same unit.
    double step(double span) const { return span / (rays - 1 + 2.0 * inset); }
};

/// The density that meets the view's error goal, by the figures of the speed-against-error report.
Sampling sampling_for(const View& view);

}  // namespace sonarsim
