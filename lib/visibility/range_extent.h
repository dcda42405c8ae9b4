#pragma once

#include <algorithm>

namespace sonarsim {

/// The extent of a patch in range before and after the range of its centre.
struct RangeExtent {
    float before;
    float after;
};

/// Along a half edge e of depth d the range is r + d s + c s^2, s in [-1, 1], with c = (e^2 - d^2)
/// / (2 r): both ends are farther than the depth alone predicts, and if the foot of the
/// perpendicular lies on the edge, the nearest point is there and not at an end.
inline RangeExtent extent_of(float squared_edge, float depth_m, float range_m) {
    const float bend = std::max(squared_edge - depth_m * depth_m, 0.0F) / (2.0F * range_m);
    const float before_foot = 0.25F * depth_m * depth_m / bend;
    return {.before = depth_m >= 2.0F * bend ? depth_m - bend : before_foot,
            .after = depth_m + bend};
}

}  // namespace sonarsim
