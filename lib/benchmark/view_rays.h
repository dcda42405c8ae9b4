#pragma once

#include <Eigen/Core>
#include <vector>

#include "visibility/view.h"

namespace sonarsim {

/// Number of rays of the yardstick for pings: the time of Embree alone for as many rays over the
/// same view of the same scene.
inline constexpr int view_rays_count = 131'072;

/// `view_rays_count` unit directions in the sensor frame, evenly spread over a view: 512 columns of
/// 256 rays, column by column.
std::vector<Eigen::Vector3f> view_rays(const View& view);

}  // namespace sonarsim
