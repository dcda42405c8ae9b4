#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/groups.h"
#include "simulate/visibility/clusters_in_view.h"
#include "simulate/visibility/strips/strip_frames.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// A triangle in the picture plane of a frame, with its corners in ascending u. Its plane is
/// q = 1 / X, linear in u and w.
struct StripTriangle {
    float u0, u1, u2;
    float w0, w1;
    float long_slope;  ///< dw/du from the first corner to the last
    float first_slope, second_slope;
    float q0, q_u, q_w;
    float q_min, q_max;
    float w_min, w_max;
    float q_middle;
    float height_m;            ///< distance of the sensor from the plane
    float side;                ///< 1: the facet's normal faces the sensor, else -1
    float area_per_unit;       ///< m^2 per unit of its picture; 0: part of a clipped triangle
    std::uint32_t facet;       ///< a number for ClustersInView::facet()
    std::uint32_t number;      ///< in one place the triangle of the lower number counts
    bool middle_above;         ///< the middle corner lies above the line between the others
    bool no_first, no_second;  ///< the corner has the u of its neighbour
};

/// The triangles that a frame sees, front to back by their clusters.
struct StripTriangles {
    std::vector<StripTriangle> items;
    std::uint64_t dropped = 0;  ///< edge-on to within rounding
    /// The upright extent of triangles that are thinner than a least column, times the width of
    /// that column, over the area of all triangles in the picture: 3 to 7 for lattices, 0.2 to 1
    /// for walls, hulls and ground.
    float thinness = 0.0F;
};

/// Projects triangles into a frame. Surface nearer than 1e-5 of the greatest range, along the
/// forward axis, is ignored.
StripTriangles strip_triangles(const ClustersInView& clusters, const ColumnFrame& frame,
                               float range_max_m);

/// The triangles that reach into each column, in their order.
Groups triangles_by_column(const std::vector<StripTriangle>& triangles,
                           const std::vector<float>& borders);

}  // namespace sonarsim
