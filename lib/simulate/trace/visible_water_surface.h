#pragma once

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Adds the water's surface that scatters, as a sonar below it sees it: in its view, and for a
/// side-scan sonar all around the track, since its beam patterns reach upwards as well. The
/// material of the samples is the one after those of the scene; they have no instance. One ray
/// decides on the visibility of each.
void add_water_surface(const View& view, const Scene& scene, const VisibilityEngine& engine,
                       const Pose& T_world_sensor, const PingMotion& motion, Samples& samples);

}  // namespace sonarsim
