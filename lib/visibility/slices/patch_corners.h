#pragma once

#include <Eigen/Core>
#include <array>

#include "core/lanes.h"
#include "visibility/slices/quad.h"

namespace sonarsim {

struct Vectors8 {
    Floats8 x, y, z;

    Eigen::Vector3f at(int lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// Corners of eight quadrilaterals of planes, in the frame of the slices: at the low end of the low
/// side and of the high side, at the high end of the high side and of the low side. Eight are
/// computed together, since the roots and divisions of one quadrilateral would wait for each other.
struct PatchCorners {
    struct Corner {
        Vectors8 at;
        Floats8 range;
        Floats8 u, w;  ///< direction
    };

    std::array<Corner, 4> corners;
    Floats8 nearest_m, farthest_m;  ///< limits of the range of its surface
    Floats8 height_m;               ///< distance of the sonar from the plane
};

PatchCorners corners_of(const std::array<Quad, lanes>& quads);

/// Parallelograms that stand for quadrilaterals, in the sensor frame.
struct Parallelograms {
    Vectors8 position;
    Vectors8 edge_u, edge_v;  ///< half an edge
    Floats8 area_m2;          ///< area of the quadrilateral; may be 0
};

/// Parallelograms whose ranges are those of the corners of the quadrilaterals, where neither edge
/// bends much. `centroid`: they lie at the centroid instead of the mean of the corners.
Parallelograms fit_parallelograms(const PatchCorners& quads, const Eigen::Matrix3f& R_sensor_frame,
                                  bool centroid);

}  // namespace sonarsim
