#pragma once

#include <Eigen/Core>
#include <array>

namespace sonarsim {

/// A half-open cube [min, min + edge), scene-local, m.
struct Cube {
    Eigen::Vector3d min;
    double edge;
};

/// A convex, planar polygon: a triangle after clipping by up to six planes.
struct Polygon {
    std::array<Eigen::Vector3d, 9> corner;
    int corners = 0;
};

using Triangle = std::array<Eigen::Vector3d, 3>;

/// The part of a triangle inside a cube; no corners if there is none. Surface in a face between two
/// cubes belongs to the cube above the face.
Polygon clip(const Triangle& triangle, const Cube& cube);

/// Integrals over surface, relative to a given point.
struct Moments {
    double area = 0.0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< integral of p dA
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< integral of p p^T dA
};

Moments moments(const Polygon& polygon, const Eigen::Vector3d& relative_to);

}  // namespace sonarsim
