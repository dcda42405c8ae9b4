#pragma once

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The scene and the sonar that a ping is traced for.
struct TraceContext {
    const View& view;
    const Scene& scene;
    const VisibilityEngine& engine;
    const Pose& T_world_sensor;
};

}  // namespace sonarsim
