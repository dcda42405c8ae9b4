#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paper/scatterers.h"
#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The echoes of one beam, one entry per piece of surface. Arrays, so that loops vectorise.
struct Echoes {
    std::vector<float> range_m;                      ///< slant range, of the middle of its extent
    std::vector<float> half_m;                       ///< half its extent in range
    std::vector<float> weight;                       ///< area of its surface, m^2
    std::vector<float> intensity;                    ///< I, Eq. 6
    std::vector<std::uint32_t> cell_low, cell_high;  ///< CellName, when there is noise

    std::size_t size() const { return range_m.size(); }
    void resize(std::size_t count, bool cells);
};

/// Turns the samples of a beam into echoes of intensity I = R (v . n), Eq. 4-6. A footprint that
/// spans several bins or scatterer cells is cut into pieces, each of them an echo that is spread
/// evenly over [range - half, range + half].
void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes);

}  // namespace sonarsim
