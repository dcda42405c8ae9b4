#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "assembly/assemble.h"
#include "preview/drawing.h"

namespace sonarsim {

/// The highest surface in each pixel of a plot of the world's x and y that lies no higher than the
/// vehicle at that pose, world z, row by row from the top; NaN where there is none.
std::vector<float> heights_below(const Assembly& assembly, std::uint32_t pose,
                                 const PlaneFrame& frame);

/// Visits the lines in which the vertical plane through `point` along `axis` (horizontal, unit)
/// cuts the triangles of the scene, world.
void for_each_cut(const Assembly& assembly, std::uint32_t pose, const Eigen::Vector3d& point,
                  const Eigen::Vector2d& axis,
                  const std::function<void(const Eigen::Vector3d&, const Eigen::Vector3d&)>& visit);

}  // namespace sonarsim
