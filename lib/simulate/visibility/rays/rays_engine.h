#pragma once

#include <memory>

#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The engine of rays, by Embree. `scene` must outlive it. std::runtime_error when out of memory.
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene);

/// The same with a caster over the scene, whose trees engines may share. `density` n: a goal that
/// is n times as fine, and n times as many columns. The rays of a goal sample lines within a beam;
/// over ground that is rough within the width of a beam, the lines do not represent the beam.
/// `along`: so many times as many rays along the columns of a fan where energies add.
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, const Caster& caster,
                                                   int density = 1, int along = 1);

}  // namespace sonarsim
