#pragma once

#include "simulate/visibility/engine.h"
#include "support/test.h"

namespace sonarsim::test {

/// A parallelogram by its centre, its normal and its half edges.
inline Sample patch_of(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                       const Eigen::Vector3f& edge_u, const Eigen::Vector3f& edge_v) {
    return {.position = position,
            .edge_u = edge_u,
            .edge_v = edge_v,
            .normal = normal,
            .height_m = std::fabs(normal.dot(position)),
            .area_m2 = 4.0F * edge_u.cross(edge_v).norm(),
            .material = 0,
            .instance = 0};
}

inline double area_of(std::span<const Sample> samples) {
    double area = 0.0;
    for (const Sample& sample : samples)
        area += static_cast<double>(sample.area_m2);
    return area;
}

inline double area_of(const Samples& samples) {
    return area_of(std::span<const Sample>(samples.items));
}

/// A square straight ahead that faces the sonar.
inline Sample plate_ahead(double range_m, double side_m) {
    const auto half = static_cast<float>(0.5 * side_m);
    return patch_of({static_cast<float>(range_m), 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F},
                    {0.0F, half, 0.0F}, {0.0F, 0.0F, half});
}

/// A point that stands for an area and faces the sonar.
inline Sample point_facing(const Eigen::Vector3f& position, double area_m2) {
    Sample point = patch_of(position, -position.normalized(), Eigen::Vector3f::Zero(),
                            Eigen::Vector3f::Zero());
    point.area_m2 = static_cast<float>(area_m2);
    return point;
}

}  // namespace sonarsim::test
