#pragma once

#include <algorithm>
#include <cmath>

#include "visibility/engine.h"

namespace sonarsim {

// Into how many pieces the footprint of a sample is cut. Inline: this runs for every sample.

/// Pieces wanted along either edge; at least 1, not yet whole.
struct Pieces {
    float u = 1.0F;
    float v = 1.0F;
};

/// One piece per scatterer cell of edge `cell_m` that the footprint spans. Where this makes more
/// than `most` pieces in all, fewer along both edges.
inline Pieces one_piece_per_cell(const Sample& sample, float cell_m, float most) {
    // edge_u and edge_v are half edges.
    float u = std::max(2.0F * sample.edge_u.norm() / cell_m, 1.0F);
    float v = std::max(2.0F * sample.edge_v.norm() / cell_m, 1.0F);
    const float excess = u * v / most;
    if (excess > 1.0F) {
        const float shrink = 1.0F / std::sqrt(excess);
        u = std::max(u * shrink, 1.0F);
        v = std::max(v * shrink, 1.0F);
    }
    return {.u = u, .v = v};
}

/// A footprint cut into u by v equal pieces.
struct Cut {
    int u = 1;
    int v = 1;

    int pieces() const { return u * v; }
};

inline Cut rounded_up(const Pieces& pieces) {
    return {.u = static_cast<int>(std::ceil(pieces.u)), .v = static_cast<int>(std::ceil(pieces.v))};
}

}  // namespace sonarsim
