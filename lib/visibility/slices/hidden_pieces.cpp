#include "visibility/slices/hidden_pieces.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace sonarsim {

namespace {

constexpr Extent everywhere{-std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::infinity()};

Extent extent_of(const Corners& c) {
    const auto [from, to] = std::minmax({c[0].u, c[1].u, c[2].u});
    return {from, to};
}

void widen(Extent& extent, const Extent& by) {
    extent = {std::min(extent.from, by.from), std::max(extent.to, by.to)};
}

/// The extents that overlap within one gap become one. `places` are in order.
void join_overlapping(std::vector<HiddenPlace>& places) {
    std::size_t last = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        HiddenPlace& before = places[last];
        if (places[i].gap == before.gap && places[i].u.from <= before.u.to) {
            widen(before.u, places[i].u);
        } else {
            places[++last] = places[i];
        }
    }
    places.resize(std::min(places.size(), last + 1));
}

}  // namespace

std::vector<HiddenPlace> find_hidden_pieces(const ClusterMesh& mesh, const SliceSetup& setup,
                                            SliceScene& scene) {
    std::vector<HiddenPlace> places;
    for (const Between& between : scene.between) {
        const std::uint32_t piece = mesh.facets[between.facet].piece;
        if (scene.met[piece]) continue;
        if (scene.piece_u.empty()) scene.piece_u.assign(mesh.pieces, everywhere);
        const Extent u = extent_of(setup.corners_of(between.facet));
        Extent& whole = scene.piece_u[piece];
        if (whole.to == everywhere.to) {
            whole = u;
        } else {
            widen(whole, u);
        }
        places.push_back({between.gap, u});
    }
    std::ranges::sort(places, [](const HiddenPlace& a, const HiddenPlace& b) {
        return std::tie(a.gap, a.u.from, a.u.to) < std::tie(b.gap, b.u.from, b.u.to);
    });
    join_overlapping(places);
    return places;
}

}  // namespace sonarsim
