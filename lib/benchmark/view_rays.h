#pragma once

#include <Eigen/Core>
#include <vector>

#include "visibility/view.h"

namespace sonarsim {

/// Number of rays for the time that pings are compared with: that of Embree alone over the same
/// view of the same scene.
inline constexpr int view_rays_count = 131'072;

/// `view_rays_count` unit directions in the sensor frame, evenly spread over a view: 512 columns of
/// 256 rays, column by column.
std::vector<Eigen::Vector3f> view_rays(const View& view);

}  // namespace sonarsim
