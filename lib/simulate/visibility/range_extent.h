#pragma once

#include <algorithm>
#include <cmath>

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

/// Pieces along either edge of a patch, at least 1.
struct PieceCounts {
    float u;
    float v;
};

/// The pieces of a patch whose half edges are `depth_u_m` and `depth_v_m` deep. Each piece is
/// represented by a box in range. The edge that spans more range is cut into pieces a bin deep, or
/// deeper at long range; the other edge, into pieces half a bin deep.
inline PieceCounts pieces_for_bins(float depth_u_m, float depth_v_m, float range_m, float bin_m) {
    // More pieces than this do not change the mean of a bin visibly.
    constexpr float max_pieces = 64.0F;
    // A piece has one intensity, but v . n = H / r on a plane: its ends are off by half of this.
    constexpr float max_depth_by_range = 0.005F;
    const float along_m = std::max(bin_m, max_depth_by_range * range_m);
    const float across_m = 0.5F * bin_m;
    const bool along_v = depth_u_m < depth_v_m;
    const float u = along_v ? 2.0F * depth_u_m / across_m : 1.0F;
    const float v = 2.0F * depth_v_m / (along_v ? along_m : across_m);
    return {.u = std::ceil(std::min(std::max(u, 1.0F), max_pieces)),
            .v = std::ceil(std::min(std::max(v, 1.0F), max_pieces))};
}

}  // namespace sonarsim
