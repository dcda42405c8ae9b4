#pragma once

#include <limits>

#include "visibility/view.h"

namespace sonarsim {

/// Error goals that coarse pieces are good enough for.
inline bool is_coarse(double relative_l1) {
    return relative_l1 >= 0.02;
}

/// What samples may be, so that a view's image comes out within its error goal.
struct PieceLimits {
    float sag_m;       ///< by which the range of a piece may miss the linear one
    float excess_m;    ///< by which its parallelogram may reach over more range than it does
    float shortest_m;  ///< no piece is cut shorter
    /// By how much more range one side of a piece may span than the other where it is made of the
    /// pieces of two strips.
    float most_wedge_m;
    float range_max_m;  ///< nothing beyond is needed
    /// By how much wider a piece may be at one end than at the other, for its parallelogram is as
    /// wide at both.
    float widest_ratio = std::numeric_limits<float>::infinity();
};

PieceLimits piece_limits(const View& view);

}  // namespace sonarsim
