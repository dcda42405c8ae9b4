#pragma once

#include <Eigen/Core>
#include <vector>

#include "visibility/view.h"

namespace sonarsim {

/// Unit vectors of the sensor frame to look around with: about a thousand over the sphere, and a
/// few dozen over the field of view, however narrow it is.
std::vector<Eigen::Vector3f> look_around(const View& view);

/// Whether a direction lies in the azimuths of a fan, whatever its elevation. Of a cone: whether it
/// lies ahead.
bool is_in_azimuth(const View& view, const Eigen::Vector3f& direction);

}  // namespace sonarsim
