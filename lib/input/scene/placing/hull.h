#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <span>
#include <vector>

namespace sonarsim {

/// A convex polygon, counter-clockwise.
using Hull = std::vector<Eigen::Vector2d>;

double area_of(const Hull& hull);

/// The convex hull of points seen from above.
Hull hull_of(std::span<const Eigen::Vector3d> points);

Eigen::AlignedBox2d box_of(const Hull& hull);

/// The distance between two convex polygons, 0 when they meet; infinite, after a quick test, if it
/// is clearly more than `most`.
double distance_between(const Hull& a, const Hull& b,
                        double most = std::numeric_limits<double>::infinity());

}  // namespace sonarsim
