#pragma once

#include <cstdint>
#include <vector>

#include "scene/seabed/bed_grid.h"

namespace sonarsim {

/// A train of ripples.
struct BedRipples {
    double height_m = 0.0;       ///< from trough to crest
    double length_m = 1.0;       ///< from crest to crest
    double direction_rad = 0.0;  ///< across the crests, from x towards y
    double spread = 0.0;         ///< deviation of the wave vector along each axis / its length
    double share = 1.0;          ///< share of the bed
    double patch_m = 10.0;       ///< size of the patches with ripples
};

/// Adds ripples, in metres. Their height is that of a cosine, height_m / 2 Re(exp(i k x) b / |b|),
/// where the complex Gaussian field b moves the crests. At the zeros of b, of which a square metre
/// has 2 pi (spread / length_m)^2, a crest ends and the height falls to 0.
void add_ripples(const BedGrid& grid, const BedRipples& ripples, std::uint64_t seed,
                 std::vector<double>& heights);

}  // namespace sonarsim
