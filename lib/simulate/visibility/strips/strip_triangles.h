#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/groups.h"
#include "simulate/visibility/clusters_in_view.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

// A view is cut into columns. Each lies in a frame of its sector of the view, with the axes forward
// (X), across (U), along (W), and is an interval of u in the picture plane u = U / X, w = W / X:
//   fan:   W is the sensor's z axis: a column is an interval of azimuth;
//   cone:  X is the boresight: a column is a chord of the cone;
//   sides: U is the sensor's z axis: a column runs along the fan.

/// The part of a line u = const that lies in the view, and dw/du of the view's borders there.
struct ColumnLimits {
    float low, high;
    float low_slope, high_slope;
};

/// One sector of a view.
struct ColumnFrame {
    enum class Border { parallels, straight, circle };

    Eigen::Matrix3f R_frame_sensor;
    double angle_low, angle_high;  ///< ends of the sector across, rad
    double stretch;                ///< u is this times the tangent of the angle
    std::vector<int> beams;        ///< for each least column; these have equal angles
    float u_low, u_high;
    Border border;  ///< the view's, in w
    float tan_low;  ///< w of the view's borders at u = 0
    float tan_high;

    /// Width of a least column at u = 0.
    float column_width() const {
        return static_cast<float>((angle_high - angle_low) / static_cast<double>(beams.size()));
    }

    ColumnLimits limits_at(float at_u) const {
        if (border == Border::straight) return {tan_low, tan_high, 0.0F, 0.0F};
        if (border == Border::circle) {
            const float half = std::sqrt(std::max(tan_high * tan_high - at_u * at_u, 0.0F));
            const float slope = half > 0.0F ? at_u / half : 0.0F;
            return {-half, half, slope, -slope};
        }
        // A parallel of the view is a hyperbola of the plane: w = tan(latitude) sqrt(1 + u^2).
        const float secant = std::sqrt(1.0F + at_u * at_u);
        return {tan_low * secant, tan_high * secant, tan_low * at_u / secant,
                tan_high * at_u / secant};
    }
    /// True only if an interval of w lies in the view over an interval of u.
    bool surely_sees(float from, float to, float low, float high) const {
        if (border != Border::circle) return low >= tan_low && high <= tan_high;
        const float max_u = std::max(std::fabs(from), std::fabs(to));
        const float max_w = std::max(std::fabs(low), std::fabs(high));
        return max_u * max_u + max_w * max_w <= tan_high * tan_high;
    }
    /// The greatest |w| in the view over an interval of u.
    float reach_w(float from, float to) const {
        const float max_u = std::max(std::fabs(from), std::fabs(to));
        const float secant = border == Border::parallels ? std::sqrt(1.0F + max_u * max_u) : 1.0F;
        return secant * std::max(std::fabs(tan_low), std::fabs(tan_high));
    }
};

/// The sectors of a view, by their beams: a beam has one least column, a wide one more, a cone 32.
std::vector<ColumnFrame> strip_frames(const View& view);

/// The borders of the columns of a frame, ascending, if each of its least columns has `parts`.
std::vector<float> column_borders(const ColumnFrame& frame, int parts);

/// A triangle in a frame's picture plane, in ascending u. Its plane q = 1 / X is linear in u, w.
struct StripTriangle {
    float u0, u1, u2;
    float w0, w1;
    float long_slope;  ///< dw/du from the first corner to the last
    float first_slope, second_slope;
    float q0, q_u, q_w;
    float q_min, q_max;
    float w_min, w_max;
    float height_m;            ///< distance of the sensor from the plane
    float side;                ///< 1: the facet's normal faces the sensor, else -1
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
    /// that column, over the area of all triangles: 3 to 7 for lattices, 0.2 to 1 for others.
    float thinness = 0.0F;
};

/// Projects triangles into a frame, without what is nearer than 1e-5 of the greatest range.
StripTriangles strip_triangles(const ClustersInView& clusters, const ColumnFrame& frame,
                               float range_max_m);

/// The triangles that reach into each column, in their order.
Groups triangles_by_column(const std::vector<StripTriangle>& triangles,
                           const std::vector<float>& borders);

}  // namespace sonarsim
