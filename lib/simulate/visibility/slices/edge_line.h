#pragma once

#include <Eigen/Core>
#include <array>

#include "simulate/visibility/slices/slice_frames.h"

namespace sonarsim {

/// A corner in the frame, and its projection to the picture plane.
struct Corner {
    float X, U, W;
    float u, w;
    float q;  ///< 1 / X
};

using Corners = std::array<Corner, 3>;

/// `p` is in the frame; points nearer than `nearest_m` in front have no projection and no q.
inline Corner corner_at(const Eigen::Vector3f& p, float nearest_m) {
    const float inverse = p.x() > nearest_m ? 1.0F / p.x() : 0.0F;
    return {p.x(), p.y(), p.z(), p.y() * inverse, p.z() * inverse, inverse};
}

/// w and q = 1 / X along an edge of the picture plane, linear in u.
struct EdgeLine {
    float anchor;  ///< u of the end where it is anchored
    float w, w_slope;
    float q, q_slope;
    Interval extent;

    float w_at(float u) const { return w + w_slope * (u - anchor); }
};

/// The line of the edge from p to q, at least one of which lies farther than `nearest_m` in front.
/// It is anchored at the farther end, so that both triangles of an edge get the same bits. If both
/// ends are in front, the slope is that between them; otherwise the other end has no projection,
/// and the slope comes from the direction of the edge.
EdgeLine edge_line(const Corner& p, const Corner& q, float nearest_m);

/// The part of a triangle that lies farther than `nearest_m` in front of the sensor.
struct FrontPart {
    static constexpr int cut = -1;

    int count = 0;  ///< number of its corners: 3 or 4; 0 if nothing is in front
    std::array<Corner, 4> corners;
    /// The triangle's side, numbered by its first corner, from each corner of the part to the next;
    /// `cut` for a side in the nearest plane.
    std::array<int, 4> sides;
};

FrontPart part_in_front(const Corners& c, float nearest_m);

/// The extent in u of the part of a triangle of the picture plane that lies between two w; from >
/// to if there is none.
Interval u_between(const Corners& corners, const Interval& w);

}  // namespace sonarsim
