#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace sonarsim {

// Interpolation weights under which white noise stays even. Bilinear weights, or the share of a
// pixel that each bin covers, add up noise differently from place to place: on the middle of a bin
// its noise comes through whole, between two bins they average. Where a pixel is about as large as
// a bin, that difference becomes a fixed moire pattern over every image.
//
// Here three bins have the weights (s - u)/2, 1 - s, (s + u)/2 at the place u in [-1/2, 1/2] bins
// from the middle one. Their sum is 1 and their centroid is u, for any s. The sum of their squares,
// which is by how much the variance of independent noise falls, is (s^2 + u^2)/2 + (1 - s)^2. It is
// the same for every u, 1/2, with
//
//     s(u) = (2 - sqrt(1 - 3 u^2)) / 3.
//
// 1/2 is also the most that weights without negative lobes can have between two bins, so this is
// the sharpest even kernel that never makes an intensity negative.

/// The weights of successive bins, for pixels centred at any of `phases` places within a bin. They
/// are multiples of 1/256 and add up to 1 exactly, so that an even surface stays even to the last
/// bit.
struct KernelTable {
    static constexpr int phases = 64;

    int taps = 0;                   ///< a multiple of 4 where vectors of 4 are to be filled
    std::vector<float> weights;     ///< [phases, taps]; 0 where a bin has none
    std::array<int, phases> first;  ///< the bin of the first tap, counted from the pixel's bin
};

/// The kernel for pixels that are `extent` bins wide: that of three bins up to an extent of 1, and
/// beyond it the mean of that kernel over the `extent - 1` bins around the pixel's centre. `taps`
/// is rounded up to a multiple of `unit`.
KernelTable make_kernel(double extent, int unit);

/// Where the centre of a pixel lies: in which bin, and in which phase of it.
struct KernelPlace {
    int bin;
    int phase;
};

/// The place at `coordinate` bins from the lower edge of bin 0, to a 64th of a bin.
KernelPlace kernel_place(double coordinate);

}  // namespace sonarsim
