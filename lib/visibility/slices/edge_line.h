#pragma once

#include "visibility/slices/scan.h"

namespace sonarsim {

/// A corner in the frame and in its picture plane.
struct Corner {
    float X, U, W;
    float u, w;
    int number;  ///< of the triangle's three
};

/// w and q = 1 / X along an edge of the picture plane, as lines over u.
struct EdgeLine {
    float anchor;  ///< u of the end that it is anchored at
    float w, w_slope;
    float q, q_slope;
    Extent extent;
};

/// The line of the edge from p to q, at least one of which lies farther than `nearest_m` in front.
/// It is anchored at the farther end. Both triangles of an edge get the same bits. The slope takes
/// an edge in front of the sensor from corner to corner; the other end of one that comes from
/// behind it has no place in the picture.
EdgeLine edge_line(const Corner& p, const Corner& q, float nearest_m);

}  // namespace sonarsim
