#pragma once

#include <memory>

#include "scene/scene.h"
#include "surface/surface.h"

namespace sonarsim {

/// The ray engine: Embree behind the Surface interface. `scene` must outlive it. Throws
/// std::runtime_error when Embree cannot build its tree (out of memory).
std::unique_ptr<Surface> make_rays_surface(const Scene& scene);

}  // namespace sonarsim
