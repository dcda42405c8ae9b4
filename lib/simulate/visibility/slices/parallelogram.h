#pragma once

#include <Eigen/Core>

#include "simulate/visibility/slices/quad.h"

namespace sonarsim {

/// A parallelogram that stands for a quadrilateral, in the sensor frame.
struct Parallelogram {
    Eigen::Vector3f position;
    Eigen::Vector3f edge_u, edge_v;  ///< half an edge
    float area_m2;                   ///< area of the quadrilateral; may be 0
};

/// A parallelogram whose ranges are those of the corners of the quadrilateral, where neither edge
/// bends much. `centroid`: it lies at the centroid instead of the mean of the corners.
Parallelogram fit_parallelogram(const Quad& quad, const QuadPoints& corners,
                                const Eigen::Matrix3f& R_sensor_frame, bool centroid);

}  // namespace sonarsim
