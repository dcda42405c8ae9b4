#pragma once

#include <algorithm>

namespace sonarsim {

/// How far the range of a piece reaches before and after that of its centre.
struct RangeExtent {
    float before;
    float after;
};

/// Along a half edge e of depth d the range is r + d s + c s^2, s in [-1, 1], with
/// c = (e^2 - d^2) / (2 r): both ends lie farther than the depth says, and beside the foot of the
/// perpendicular there is no near end.
inline RangeExtent extent_of(float squared_edge, float depth_m, float range_m) {
    const float bend = std::max(squared_edge - depth_m * depth_m, 0.0F) / (2.0F * range_m);
    const float before_foot = 0.25F * depth_m * depth_m / bend;
    return {.before = depth_m >= 2.0F * bend ? depth_m - bend : before_foot,
            .after = depth_m + bend};
}

}  // namespace sonarsim
