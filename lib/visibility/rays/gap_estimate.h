#pragma once

#include "visibility/rays/ray_columns.h"
#include "visibility/rays/sampling.h"

namespace sonarsim {

// What two neighbouring rays tell about the surface between them, by the planes that they met.

/// Between two neighbours on a chain.
struct Between {
    bool joined = true;       ///< the surface goes on from the one to the other
    float border = 0.5F;      ///< where the one gives way to the other, as a share of the way
    float at_stake_m = 0.0F;  ///< metres of range that may echo otherwise than the planes do
    bool turns = false;       ///< it goes on and turns by more than five degrees
};

/// The surface goes on where the two planes are nearly one, or where they cross between the rays:
/// an edge of two facets, which is then found exactly. What is at stake is the part of the planes
/// that lies between the rays, for the share by which its cosine may be off. Where the surface
/// breaks off it is all that either plane could reach before the other ray, up to `reach_m`, the
/// greatest range that echoes. The angle between the rays is small.
Between between(const ChainNode& a, const ChainNode& b, const Sampling& sampling, float reach_m);

/// The angle along the chain of the ray that splits the gap between two neighbours on it.
float next_along(const ChainNode& a, const ChainNode& b, float reach_m);

/// Whether neighbours on two columns met what cannot be taken for one plane of one material.
bool disagree(const ChainNode& a, const ChainNode& b, const Sampling& sampling, float reach_m);

}  // namespace sonarsim
