#pragma once

#include <cstdint>
#include <span>

#include "simulate/paper/echoes.h"
#include "simulate/trace/range_boxes.h"

namespace sonarsim {

/// The area-weighted mean of each bin, Eq. 9; 0 in bins without surface. Returns the number of bins
/// with surface.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity);

/// Writes the means of `beams` beams, `by_beam` [beams, range bins], into as many columns of
/// `image`, [range bins, columns], from the column `first` on.
void write_beams(std::span<const float> by_beam, int beams, int first, int columns,
                 std::span<float> image);

}  // namespace sonarsim
