#pragma once

#include "visibility/engine.h"
#include "visibility/rays/ray_columns.h"

namespace sonarsim {

/// The surface that the columns of rays have seen. Each ray stands for a segment of its column, as
/// a flat piece of the plane that it met. Where the surface is continuous from one ray to the next,
/// the pieces meet where the two planes do, so that a surface of facets is seen exactly; where it
/// breaks off, they end half way.
Samples column_samples(const View& view, const Sampling& sampling, const RayColumns& columns);

}  // namespace sonarsim
