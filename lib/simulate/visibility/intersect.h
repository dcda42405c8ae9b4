#pragma once

#include <Eigen/Core>
#include <span>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// VisibilityEngine::intersect by ray tracing, for all engines.
void intersect_rays(const Caster& caster, const Eigen::Vector3d& scene_origin,
                    const Pose& T_world_sensor, std::span<const Ray> rays,
                    std::span<Intersection> intersections);

}  // namespace sonarsim
