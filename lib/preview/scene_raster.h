#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "assembly/assemble.h"
#include "preview/drawing.h"

namespace sonarsim {

/// The height (world z) of the highest surface below the vehicle in each pixel of a plot of the
/// world's x and y, row by row from the top; NaN where there is no surface.
std::vector<float> heights_below(const Assembly& assembly, std::uint32_t pose,
                                 const PlaneFrame& frame);

/// Visits the line segments in which the vertical plane through `point` along `axis` (a horizontal
/// unit vector) cuts the triangles of the scene, world.
void for_each_cut(const Assembly& assembly, std::uint32_t pose, const Eigen::Vector3d& point,
                  const Eigen::Vector2d& axis,
                  const std::function<void(const Eigen::Vector3d&, const Eigen::Vector3d&)>& visit);

}  // namespace sonarsim
