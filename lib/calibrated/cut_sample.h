#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "calibrated/patches.h"
#include "trace/arrivals.h"
#include "visibility/engine.h"

// The extents of the pieces that samples are cut into, for labels.

namespace sonarsim {

/// Half the extent of a piece in range, and across the beams.
struct HalfExtents {
    float range_m, sine;
};

/// The extents of a piece of a parallelogram with these half edges that is cut into rows and
/// columns, at a place that is seen along `at`.
inline HalfExtents half_extents(const Eigen::Vector3f& edge_u, const Eigen::Vector3f& edge_v,
                                const Arrival& at, float rows = 1.0F, float columns = 1.0F) {
    const EdgeExtents u = extents_of(edge_u, at.direction);
    const EdgeExtents v = extents_of(edge_v, at.direction);
    return {std::fabs(u.depth) / rows + std::fabs(v.depth) / columns,
            std::fabs(u.y) / at.range_m / rows + std::fabs(v.y) / at.range_m / columns};
}

/// A sample as subdivide() cuts it.
struct CutSample {
    const Sample* sample = nullptr;
    float rows = 1.0F, columns = 1.0F;
    HalfExtents half{};  ///< extents of a piece
};

inline CutSample cut_of(const Sample& sample, const PointLimits& limits) {
    const Arrival at = arrival_of(sample.position);
    CutSample out{.sample = &sample};
    out.rows = static_cast<float>(patches_along(sample.edge_u, at.direction, at.range_m, limits));
    out.columns =
        static_cast<float>(patches_along(sample.edge_v, at.direction, at.range_m, limits));
    out.half = half_extents(sample.edge_u, sample.edge_v, at, out.rows, out.columns);
    return out;
}

}  // namespace sonarsim
