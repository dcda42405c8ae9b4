#pragma once

#include "visibility/engine.h"

namespace sonarsim {

/// Into how many pieces a footprint should be cut along either edge; at least 1, not yet whole.
struct Pieces {
    float u = 1.0F;
    float v = 1.0F;
};

/// One piece per scatterer cell of edge `cell_m` that the footprint spans. Where this makes more
/// than `most` pieces in all, fewer along both edges.
Pieces one_piece_per_cell(const Sample& sample, float cell_m, float most);

/// A footprint cut into u by v equal pieces.
struct Cut {
    int u = 1;
    int v = 1;

    int pieces() const { return u * v; }
};

Cut rounded_up(const Pieces& pieces);

}  // namespace sonarsim
