#pragma once

#include <memory>

#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The slices engine: half-planes through the sensor, exact along each. `scene` must outlive it.
/// The caster over the scene traces the secondary rays. `per_beam`: slices per beam; 0: the view's
/// error goal determines them.
std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene, const Caster& caster,
                                                     int per_beam = 0);

}  // namespace sonarsim
