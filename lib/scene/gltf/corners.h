#pragma once

#include <Eigen/Geometry>
#include <array>

namespace sonarsim {

inline bool has_area(const std::array<Eigen::Vector3d, 3>& p) {
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm() > 0.0;
}

inline bool is_finite(const std::array<Eigen::Vector3d, 3>& p) {
    return p[0].allFinite() && p[1].allFinite() && p[2].allFinite();
}

}  // namespace sonarsim
