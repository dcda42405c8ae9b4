#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/probe.h"

namespace sonarsim {

/// With more triangles than this `auto` takes rays for every view. A ping of the slices needs up to
/// 600 bytes for each triangle in view: measured over rough ground, 5 GB and 60 s for 8.4 million.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

/// The least density of rays (rays_engine.h) at which their own estimate is half of the goal on
/// the probes of a view, or the greatest that is tried if all miss it: a ping's estimate says so
/// then. Only parts of a fan are traced.
int density_for(const Scene& scene, const Caster& caster, const View& view,
                std::span<const Probe> probes);

/// Rays for every view, with density_for() it. A view without probes gets the greatest of the
/// others. `coverage` as for make_rays_engine().
std::unique_ptr<VisibilityEngine> make_dense_rays_engine(const Scene& scene, const Caster& caster,
                                                         std::span<const Probe> probes,
                                                         bool coverage);

}  // namespace sonarsim
