#pragma once

#include "core/pose.h"
#include "core/random.h"
#include "input/scene/scene.h"
#include "simulate/paper/echoes.h"
#include "simulate/paper/scatterers.h"

namespace sonarsim {

/// The range noise of one sonar, Eq. 7-8.
struct RangeNoise {
    float lambda_m = 0.0F;     ///< mean of the exponential distribution; 0: no range noise
    float scatterer_m = 0.0F;  ///< edge of the cells that share a draw
    bool fades = true;         ///< late echoes are weaker by exp(-w / lambda), Eq. 8
};

/// The cells in which a sonar at `T_world_sensor` draws its range noise; none where there is none.
ScattererLattice scatterer_lattice(const RangeNoise& noise, const Scene& scene,
                                   const Pose& T_world_sensor);

/// Every scatterer cell draws w from the exponential distribution of mean lambda. Its echoes arrive
/// w later (Eq. 7) and, if the noise fades, weaker by exp(-w / lambda) (Eq. 8).
void add_range_noise(Echoes& echoes, const RangeNoise& noise, PhiloxKey key);

}  // namespace sonarsim
