#pragma once

#include <memory>

#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// An engine that cuts the triangles in view into the columns of the view, a few for each beam, and
/// finds what nearer pieces of its column leave of each piece, on the line in the middle of it.
/// `scene` must outlive it; the scene must have no bodies, no copies and no profile of sound speed.
std::unique_ptr<VisibilityEngine> make_strips_engine(const Scene& scene, const Caster& caster);

}  // namespace sonarsim
