#pragma once

#include "simulate/visibility/engine.h"
#include "simulate/visibility/rays/ray_columns.h"

namespace sonarsim {

/// The surface that the columns of rays have met. Each ray represents a segment of its column as a
/// flat patch of the plane that it met. If the surface is continuous from one ray to the next,
/// their patches meet where the two planes do, so faceted surface is reproduced exactly; otherwise
/// they end half way. Appends the samples of `beams` to `samples`, which holds those of the earlier
/// beams.
void add_column_samples(const View& view, const Sampling& sampling, const RayColumns& columns,
                        BeamRange beams, Samples& samples);

}  // namespace sonarsim
