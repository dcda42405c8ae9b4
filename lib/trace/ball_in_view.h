#pragma once

#include <Eigen/Core>

#include "visibility/view.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// A ball in the sensor frame that does not hold the sonar.
struct TargetBall {
    Eigen::Vector3f centre;
    float range_m, radius_m;
};

/// The position of a ball relative to a view. `widened`: the view with its guard beams. If it has
/// any (`guarded`), a ball is at most partly inside, since the beams' cones do not fill the guard
/// beams.
Containment ball_in_view(const View& view, const View& widened, bool guarded,
                         const TargetBall& ball);

}  // namespace sonarsim
