#pragma once

#include "surface/chains.h"
#include "surface/surface.h"

namespace sonarsim {

/// The surface that chains have seen. Every ray stands for the part of its chain that is nearer to
/// it than to its neighbours, as a flat piece; where neighbours lie on one surface, their pieces
/// meet half way between the two planes, so that a smooth surface stays smooth.
void chain_samples(const View& view, const Sampling& sampling, const Chains& chains,
                   Samples& samples);

}  // namespace sonarsim
