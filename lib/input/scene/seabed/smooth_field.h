#pragma once

#include <vector>

#include "core/random.h"
#include "input/scene/seabed/bed_grid.h"

namespace sonarsim {

/// A Gaussian random field on the cells of a grid, in its order: mean 0, variance 1, correlation
/// exp(-(r / (2 length))^2) at the distance r. Its power spectrum over wave vectors k, whose
/// integral is the variance, is length^2 / pi exp(-(length k)^2).
///
/// The field is a sum of bells exp(-(r / length)^2 / 2) on a square lattice of spacing `length`,
/// each times a normal number. The lattice makes the variance vary by 1e-4 of itself. A value
/// depends only on the key and on the place, not on the part of the grid that is made. A length
/// below a hundredth of a cell is a hundredth: in both cases no two cells are correlated.
std::vector<float> smooth_field(const BedGrid& grid, double length_m, PhiloxKey key);

}  // namespace sonarsim
