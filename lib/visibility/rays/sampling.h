#pragma once

#include "visibility/view.h"

namespace sonarsim {

/// A split column is a wide strip between two narrow ones, each this share of its width. A bin is
/// as bright for a sliver of surface as for a full view, so what counts is that a silhouette within
/// the column has rays on both of its sides: equal thirds miss one in three, these one in ten.
inline constexpr float margin = 0.1F;

/// By this share of the greatest range rays go beyond it. What lies there can neither echo nor hide
/// what does, but it tells whether a surface goes on.
inline constexpr float beyond = 0.01F;

/// How densely the rays engine samples a view.
struct Sampling {
    int columns = 1;     ///< per beam (of a fan), per side, or round the cone
    int chain = 32;      ///< rays along a column before refinement, 2 at least
    float inset = 0.5F;  ///< steps of those rays from a column's ends to its first and last ray
    int levels = 8;      ///< a gap between two of them is split so many times at most
    int turns = 1;       ///< and at least so many times where the surface turns in it
    bool split = true;   ///< columns whose neighbours disagree are seen in strips
    float at_stake_m = 0.0F;        ///< gaps with more than this at stake are split
    float tolerance_m = 0.0F;       ///< by how much a neighbour's plane may miss a range
    float tolerance_cosine = 0.1F;  ///< by which share of itself a cosine may differ across columns

    /// From ray to ray of a column that spans `span`, before refinement; same unit.
    double step(double span) const { return span / (chain - 1 + 2.0 * inset); }
};

/// The density that meets the view's error goal, by the figures of the speed-against-error report.
Sampling sampling_for(const View& view);

}  // namespace sonarsim
