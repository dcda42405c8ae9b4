#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim {

/// With more triangles than this rays are dense where a bin holds a mean.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

/// With more triangles than this `auto` takes rays, whose time hardly depends on their number: over
/// a sea floor of a million 0.56 of the time of slices at an error of 1.9 instead of 1.5 %, over a
/// wreck of 175,000 an error of 5.2 instead of 2.9 %.
constexpr std::size_t slices_triangles_max = std::size_t{1} << 19;

/// Traces each view by slices or by rays. Rays: scenes with bodies or copies, scenes of many
/// triangles, and the views `by_rays`. `scene` must outlive the engine. Throws std::runtime_error
/// when Embree cannot build its tree.
std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const Caster& caster,
                                                   std::vector<View> by_rays);

}  // namespace sonarsim
