#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/paper/scatterers.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Echoes of the paper's model: their weights are areas.
struct Echoes : RangeBoxes {
    std::vector<std::uint32_t> cell_low, cell_high;  ///< CellName, when there is noise

    void resize(std::size_t count, bool cells);
};

/// Turns the samples of a beam into echoes of intensity I = R (v . n), Eq. 4-6. A footprint that
/// spans several bins or scatterer cells is cut into pieces, each of them an echo that is spread
/// evenly over [range - half, range + half]. `ends` becomes the end of each sample's echoes; null:
/// not wanted.
void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes,
                   std::vector<std::uint32_t>* ends = nullptr);

/// The area-weighted mean of each bin, Eq. 9; 0 in bins without surface. Returns the number of bins
/// with surface.
std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity);

/// Writes the means of `beams` beams, `by_beam` [beams, range bins], into as many columns of
/// `image`, [range bins, columns], from the column `first` on.
void write_beams(std::span<const float> by_beam, int beams, int first, int columns,
                 std::span<float> image);

}  // namespace sonarsim
