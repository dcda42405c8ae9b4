#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "input/scene/scene.h"
#include "simulate/paper/scatterers.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/range_extent.h"

namespace sonarsim {

/// One piece per scatterer cell of edge `cell_m` that a footprint with half edges of length `u_m`
/// and `v_m` spans, before rounding to whole numbers. Where this makes more than `most` pieces in
/// all, fewer along both edges.
inline PieceCounts one_piece_per_cell(float u_m, float v_m, float cell_m, float max_pieces) {
    const float u = std::max(2.0F * u_m / cell_m, 1.0F);
    const float v = std::max(2.0F * v_m / cell_m, 1.0F);
    const float shrink = 1.0F / std::sqrt(std::max(u * v / max_pieces, 1.0F));
    return {.u = std::max(u * shrink, 1.0F), .v = std::max(v * shrink, 1.0F)};
}

/// A block of samples, and how they are cut into pieces. Arrays, so that loops vectorise.
struct Footprints {
    static constexpr int capacity = 64;
    using Floats = std::array<float, capacity>;
    using Vectors = std::array<Floats, 3>;  ///< x, y, z

    int count = 0;  ///< number of samples, rounded up to whole vectors with the last sample
    Vectors position, edge_u, edge_v;  ///< m, sensor frame
    Floats height_m, area_m2, reflection;
    Vectors cell, cell_u, cell_v;  ///< the same in scatterer cells, if there is noise

    Floats range_m, depth_u_m,
        depth_v_m;   ///< range of the centre; extent in range of each half edge
    Floats u, v;     ///< whole numbers: pieces along either edge
    Floats half_m;   ///< half the extent of a piece in range
    Floats shift_m;  ///< middle of that extent, relative to the centre of the piece
    Floats weight;   ///< area of a piece, m^2
};

/// Makes the footprints of at most `Footprints::capacity` samples and cuts them: into one piece per
/// scatterer cell or, without cells, so that no piece is deeper than the bins resolve.
void cut_footprints(std::span<const Sample> samples, std::span<const Material> materials,
                    float bin_m, const ScattererLattice& lattice, Footprints& footprints);

}  // namespace sonarsim
