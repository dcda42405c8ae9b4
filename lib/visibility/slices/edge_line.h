#pragma once

#include <Eigen/Core>
#include <array>

#include "visibility/slices/scan.h"

namespace sonarsim {

/// A corner in the frame and in its picture plane.
struct Corner {
    float X, U, W;
    float u, w;
};

using Corners = std::array<Corner, 3>;

/// `p` is in the frame; what lies nearer than `nearest_m` in front has no place in the picture.
inline Corner corner_at(const Eigen::Vector3f& p, float nearest_m) {
    const float inverse = p.x() > nearest_m ? 1.0F / p.x() : 0.0F;
    return {p.x(), p.y(), p.z(), p.y() * inverse, p.z() * inverse};
}

/// w and q = 1 / X along an edge of the picture plane, as lines over u.
struct EdgeLine {
    float anchor;  ///< u of the end that it is anchored at
    float w, w_slope;
    float q, q_slope;
    Extent extent;

    float w_at(float u) const { return w + w_slope * (u - anchor); }
};

/// The line of the edge from p to q, at least one of which lies farther than `nearest_m` in front.
/// It is anchored at the farther end. Both triangles of an edge get the same bits. The slope takes
/// an edge in front of the sensor from corner to corner; the other end of one that comes from
/// behind it has no place in the picture.
EdgeLine edge_line(const Corner& p, const Corner& q, float nearest_m);

/// The part of a triangle that lies farther than `nearest_m` in front of the sensor.
struct FrontPart {
    static constexpr int cut = -1;

    int count = 0;  ///< of its corners: 3 or 4; 0 when nothing is in front
    std::array<Corner, 4> corners;
    /// The side of the triangle, from corner k to the next, that leads from each corner to the
    /// next; `cut` where the nearest plane cuts it.
    std::array<int, 4> sides;
};

FrontPart part_in_front(const Corners& c, float nearest_m);

}  // namespace sonarsim
