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

/// Beams beside a view in which surface is looked for as well.
struct BeamsBeside {
    int count = 0;        ///< to either side
    double beam_rad = 0;  ///< how wide they are; 0: as wide as those of the view
};

/// The whole view in which surface is looked for.
View heard_view(const View& view, const BeamsBeside& beside);

/// Whether the cones of a fan's beams reach a point beside it: where its y / r is no more than that
/// of the view's borders on the horizontal plane. `position` in the sensor frame.
bool is_reached(const View& view, const Eigen::Vector3f& position);

/// What an engine sees within the view and, in the beams beside it, where its beams reach.
HeardSurface heard_surface(const View& view, const BeamsBeside& beside,
                           const VisibilityEngine& engine, const Pose& T_world_sensor);

}  // namespace sonarsim
