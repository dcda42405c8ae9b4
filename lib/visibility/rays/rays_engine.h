#pragma once

#include <memory>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The ray tracing engine, based on Embree. `scene` must outlive it. `coverage`: covered_bins()
/// will be called, so what it needs is made now. Throws std::runtime_error when Embree cannot build
/// its tree (out of memory).
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, bool coverage = false);
/// The same with a caster over the scene, whose trees engines may share.
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, const Caster& caster,
                                                   bool coverage);

}  // namespace sonarsim
