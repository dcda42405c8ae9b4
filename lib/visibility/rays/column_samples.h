#pragma once

#include "visibility/engine.h"
#include "visibility/rays/ray_columns.h"

namespace sonarsim {

/// The surface that chains have seen. Every ray stands for a part of its chain, as a flat piece of
/// the plane that it met. Where the surface goes on to the next ray, the pieces meet where the two
/// planes do, and a surface of facets is seen as it is; where it breaks off, they end half way.
Samples chain_samples(const View& view, const Sampling& sampling, const Chains& chains);

}  // namespace sonarsim
