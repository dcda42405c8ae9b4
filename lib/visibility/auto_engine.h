#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/probe.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim {

/// With more triangles than this `auto` takes rays for every view, dense ones where a bin holds a
/// mean. A ping of the slices needs up to
/// 600 bytes for each triangle in view: measured over rough ground, 5 GB and 60 s for 8.4 million.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

/// Traces each view by slices or by rays. Rays: scenes with bodies or copies, scenes of many
/// triangles, and views for which one of `probes` requires rays. `scene` must outlive the engine.
/// Throws std::runtime_error when Embree cannot build its tree.
std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const Caster& caster,
                                                   const SlicesOptions& slices,
                                                   std::span<const Probe> probes);

}  // namespace sonarsim
