#pragma once

#include <vector>

#include "visibility/slices/edge_line.h"

namespace sonarsim {

/// A piece of a triangle that lies between two slices, so that no slice meets it.
struct UnseenPiece {
    Interval facet_u;  ///< extent of its triangle within the view
    float u, w, q;     ///< its middle; q = 1 / X
    float area_m2;
    Interval range_m;
    float height_m;  ///< distance of the sensor from its plane
    float reflection;
};

/// Appends the pieces of a triangle between two limits of w. The pieces are slabs of w, so that
/// nearly every piece is visible or hidden as a whole. `normal` is that of the triangle's plane, on
/// either side.
void add_unseen_pieces(const Corners& corners, const Eigen::Vector3f& normal, float reflection,
                       const Interval& view_w, std::vector<UnseenPiece>& out);

}  // namespace sonarsim
