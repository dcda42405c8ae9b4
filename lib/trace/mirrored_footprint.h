#pragma once

#include "trace/bounce_tracer.h"
#include "trace/mirrored_pieces.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The piece of the plane of `second` that the footprint of a sample mirrors sound to, as the
/// calibrated model takes it. With t the length of the way to p in units of |p_i| it is seen in the
/// mirror at t p_i, and it has the area A_i (v_i . n_i) t^2 / |r_i . n_h|: all the sound that meets
/// the sample goes on to it, whatever lies between. `second` is of a material.
MirroredPiece mirrored_footprint(const SecondLegs& context, const Sample& sample,
                                 const SecondHit& second);

}  // namespace sonarsim
