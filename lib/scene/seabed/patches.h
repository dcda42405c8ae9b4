#pragma once

#include <vector>

#include "scene/seabed/bed_grid.h"

namespace sonarsim {

/// The quantile of the normal(0, 1) distribution, within 1e-6; infinite for 0 and 1.
double normal_quantile(double probability);

/// A number in [0, 1] for each cell: 1 in the patches that cover a share of the bed, and 0 between
/// them. The border is a tenth of a patch wide. For a share of one half, a patch and the gap to the
/// next one are `patch_m` long together, on average over all directions.
std::vector<float> patches(const BedGrid& grid, double share, double patch_m, PhiloxKey key);

/// The `length_m` of a smooth_field() that crosses its mean upwards once in `patch_m`, on average
/// along a line.
double length_of_patches(double patch_m);

}  // namespace sonarsim
