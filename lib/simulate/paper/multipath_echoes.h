#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/paper/echoes.h"
#include "simulate/trace/multipath.h"

namespace sonarsim {

/// The multipath echoes of all beams.
struct MultipathEchoes {
    Echoes echoes;                          ///< sorted by beam
    std::vector<std::uint32_t> beam_begin;  ///< beams + 1 offsets into `echoes`
    std::vector<std::uint32_t> path;        ///< index into the paths, by echo
};

/// Turns the paths that are not scattered into echoes with the weight and the scatterer cells of
/// their samples. A footprint that spans several beams, or cells where there is range noise, is cut
/// into pieces.
MultipathEchoes multipath_echoes(std::span<const BouncePath> bounces, const Samples& samples,
                                 const View& view, const ScattererLattice& lattice);

}  // namespace sonarsim
