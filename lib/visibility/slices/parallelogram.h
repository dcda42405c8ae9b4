#pragma once

#include <Eigen/Core>
#include <array>

#include "core/lanes.h"
#include "visibility/slices/quad.h"

namespace sonarsim {

/// Eight quadrilaterals. They are computed together, since the roots and divisions of one would
/// wait for each other.
struct QuadBatch {
    std::array<QuadPoints, lanes> corners;
    std::array<float, lanes> nearest_m, farthest_m;  ///< limits of the range of its surface
    std::array<float, lanes> height_m;               ///< distance of the sonar from the plane

    void set(int lane, const Quad& quad, const QuadPoints& points) {
        corners[lane] = points;
        nearest_m[lane] = quad.range_m.from;
        farthest_m[lane] = quad.range_m.to;
        height_m[lane] = quad.height_m;
    }
};

struct Vectors8 {
    Floats8 x, y, z;

    Eigen::Vector3f at(int lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// Parallelograms that stand for quadrilaterals, in the sensor frame.
struct Parallelograms {
    Vectors8 position;
    Vectors8 edge_u, edge_v;  ///< half an edge
    Floats8 area_m2;          ///< area of the quadrilateral; may be 0
};

/// Parallelograms whose ranges are those of the corners of the quadrilaterals, where neither edge
/// bends much. `centroid`: they lie at the centroid instead of the mean of the corners.
Parallelograms fit_parallelograms(const QuadBatch& quads, const Eigen::Matrix3f& R_sensor_frame,
                                  bool centroid);

}  // namespace sonarsim
