#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "input/scene/placing/bottom.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// Returns the height by which `object` has to be raised so that it touches the bottom and nowhere
/// reaches below the bottom's highest surface; negative if it hovers. Returns nullopt if a vertex
/// has no bottom below or above it. Both are triangles, so the least gap lies where a vertex of one
/// is above or below the other, or where two edges cross as seen from above; all are checked.
std::optional<double> lift_to_rest(const Bottom& bottom, const Surface& object);

/// True if all of the object lies below the lowest surface of the bottom.
bool lies_below(const Bottom& bottom, const Surface& object);

/// The rotation that tilts the world's z to the normal of the plane fitted to the bottom on a grid
/// over the box; the identity if too little of the bottom lies in the box.
Eigen::Quaterniond slope_of(const Bottom& bottom, const Eigen::AlignedBox2d& box);

/// A convex polygon, counter-clockwise.
using Hull = std::vector<Eigen::Vector2d>;

double area_of(const Hull& hull);

/// The convex hull of points seen from above.
Hull hull_of(std::span<const Eigen::Vector3d> points);

Eigen::AlignedBox2d box_of(const Hull& hull);

/// The distance between two convex polygons; infinite if a quick test finds it above `most`.
double distance_between(const Hull& a, const Hull& b,
                        double max_m = std::numeric_limits<double>::infinity());

}  // namespace sonarsim
