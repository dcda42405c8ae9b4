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

/// The position of a ball relative to a view: `widened` is the view with its guard beams, if it is
/// `guarded`.
Containment ball_in_view(const View& view, const View& widened, bool guarded,
                         const TargetBall& ball);

}  // namespace sonarsim
