#pragma once

#include <vector>

#include "core/pose.h"
#include "trace/ping_motion.h"
#include "trace/visible_surface.h"
#include "trace/water_mirror.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The water's surface that a sonar below it sees: in its view, and for a side-scan sonar all
/// around the track, since its beam patterns reach upwards as well. Material and instance of the
/// samples are 0. One ray decides on the visibility of each.
std::vector<Sample> visible_water_surface(const WaterMirror& surface, const View& view,
                                          const GuardBeams& guard_beams,
                                          const VisibilityEngine& engine,
                                          const Pose& T_world_sensor, const PingMotion& motion);

}  // namespace sonarsim
