#pragma once

#include <vector>

#include "core/pose.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The visible surface that a sonar hears.
struct HeardSurface {
    Samples samples;             ///< within its view
    std::vector<Sample> beside;  ///< beside it, where the cones of a line array's beams reach
};

/// The view in which surface is looked for: with so many beams more to either side.
View heard_view(const View& view, int beams_beside);

/// Whether the cones of a fan's beams reach a point beside it: where its y / r is no more than that
/// of the view's borders on the horizontal plane. `position` in the sensor frame.
bool is_reached(const View& view, const Eigen::Vector3f& position);

/// What an engine sees within the view and, in `beams_beside` beams to either side of it, where its
/// beams reach.
HeardSurface heard_surface(const View& view, int beams_beside, const VisibilityEngine& engine,
                           const Pose& T_world_sensor);

}  // namespace sonarsim
