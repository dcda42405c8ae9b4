#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sonarsim {

/// A convex polygon, counter-clockwise.
using Hull = std::vector<Eigen::Vector2d>;

/// The convex hull of points seen from above.
Hull hull_of(std::span<const Eigen::Vector3d> points);

/// The distance between two convex polygons; 0 when they meet.
double distance_between(const Hull& a, const Hull& b);

}  // namespace sonarsim
