#pragma once

#include <memory>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The ray engine: Embree behind the Surface interface. `scene` must outlive it. Throws
/// std::runtime_error when Embree cannot build its tree (out of memory).
std::unique_ptr<Surface> make_rays_surface(const Scene& scene);

/// Surface::hit by tracing rays: both engines answer it so.
void trace_rays(const Caster& caster, const Eigen::Vector3d& scene_origin,
                const Pose& T_world_sensor, std::span<const Ray> rays, std::span<Hit> hits);

}  // namespace sonarsim
