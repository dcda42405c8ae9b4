#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace sonarsim {

// Interpolation weights that keep the variance of white noise uniform. Bilinear weights, or the
// share of a pixel that each bin covers, do not: at the middle of a bin the noise passes unchanged,
// between two bins it is averaged. When a pixel is about as large as a bin, this shows as a fixed
// moire pattern in every image.
//
// Here three bins have the weights (s - u)/2, 1 - s, (s + u)/2 at the place u in [-1/2, 1/2] bins
// from the middle one. Their sum is 1 and their centroid is u, for any s. The variance of
// independent noise is multiplied by the sum of their squares, (s^2 + u^2)/2 + (1 - s)^2. This is
// 1/2 for every u with
//
//     s(u) = (2 - sqrt(1 - 3 u^2)) / 3.
//
// Weights without negative lobes cannot exceed 1/2 between two bins, so this is the sharpest
// uniform kernel that makes no intensity negative.

/// The weights of successive bins for pixels centred at `phases` places within a bin. They are
/// multiples of 1/256 and add up to exactly 1, so that a uniform surface stays uniform to the last
/// bit.
struct KernelTable {
    static constexpr int phases = 64;

    int taps = 0;                   ///< number of weights, a multiple of `unit`
    std::vector<float> weights;     ///< [phases, taps]; padded with 0
    std::array<int, phases> first;  ///< the bin of the first tap, counted from the pixel's bin
};

/// Makes the kernel for pixels that are `extent` bins wide: the kernel of three bins up to an
/// extent of 1, and beyond it the mean of that kernel over the `extent - 1` bins around the pixel's
/// centre. `taps` is rounded up to a multiple of `unit`.
KernelTable make_kernel(double extent, int unit);

/// The place of a pixel's centre: its bin and the phase within the bin.
struct KernelPlace {
    int bin;
    int phase;
};

/// The place at `coordinate` bins from the lower edge of bin 0, to a 64th of a bin.
KernelPlace kernel_place(double coordinate);

}  // namespace sonarsim
