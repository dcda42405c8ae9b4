#include "ping/footprint.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

Pieces one_piece_per_cell(const Sample& sample, float cell_m, float most) {
    // edge_u and edge_v are half edges.
    const float u = std::max(2.0F * sample.edge_u.norm() / cell_m, 1.0F);
    const float v = std::max(2.0F * sample.edge_v.norm() / cell_m, 1.0F);
    const float excess = u * v / most;
    if (!(excess > 1.0F)) return {u, v};
    const float shrink = 1.0F / std::sqrt(excess);
    return {std::max(u * shrink, 1.0F), std::max(v * shrink, 1.0F)};
}

Cut rounded_up(const Pieces& pieces) {
    return {.u = static_cast<int>(std::ceil(pieces.u)), .v = static_cast<int>(std::ceil(pieces.v))};
}

}  // namespace sonarsim
