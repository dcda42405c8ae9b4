#pragma once

#include <vector>

#include "scene/seabed/bed_grid.h"

namespace sonarsim {

/// The number that a normal(0, 1) number stays below with this probability, within 1e-6;
/// infinite for 0 and 1.
double normal_quantile(double probability);

/// A number in [0, 1] for each cell, 1 in the patches that cover a share of the bed and 0 between
/// them. The border is a tenth of a patch wide. A patch and the gap to the next are `patch_m` long
/// together, on average of all directions and for a share of one half.
std::vector<float> patches(const BedGrid& grid, double share, double patch_m, PhiloxKey key);

/// The length of a smooth field that crosses its mean upwards once in `patch_m` along a line.
double length_of_patches(double patch_m);

}  // namespace sonarsim
