#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulate/visibility/view.h"

namespace sonarsim {

/// Unit vectors of the sensor frame along which to look for surface: about a thousand over the
/// sphere, and a few dozen over the field of view, however narrow it is.
std::vector<Eigen::Vector3f> look_around(const View& view);

/// True if a direction lies in the azimuths of a fan, at any elevation. For a cone: if it lies
/// ahead.
bool is_in_azimuth(const View& view, const Eigen::Vector3f& direction);

}  // namespace sonarsim
