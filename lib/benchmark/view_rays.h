#pragma once

#include <Eigen/Core>
#include <vector>

#include "visibility/view.h"

namespace sonarsim {

/// Rays of the yardstick that pings are measured by: what Embree alone needs to trace as many over
/// the same view of the same scene.
inline constexpr int view_rays_count = 131'072;

/// `view_rays_count` directions of the sensor frame, unit length, evenly over a view: 512 columns
/// of 256, neighbours of a column one after the other.
std::vector<Eigen::Vector3f> view_rays(const View& view);

}  // namespace sonarsim
