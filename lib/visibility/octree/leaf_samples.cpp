#include "visibility/octree/leaf_samples.h"

#include <algorithm>

#include "visibility/octree/shadow.h"

namespace sonarsim {

namespace {

constexpr float cells_per_leaf = 3.0F;

/// Samples by beam, in the order given within a beam.
Samples sorted_by_beam(const std::vector<Sample>& from, const std::vector<std::uint32_t>& beam,
                       int beams) {
    Samples to;
    to.beam_begin.assign(beams + 1, 0);
    for (const std::uint32_t b : beam)
        ++to.beam_begin[b + 1];
    for (int b = 0; b < beams; ++b)
        to.beam_begin[b + 1] += to.beam_begin[b];
    std::vector<std::uint32_t> next(to.beam_begin.begin(), to.beam_begin.end() - 1);
    to.items.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
        to.items[next[beam[k]]++] = from[k];
    return to;
}

}  // namespace

Samples leaf_samples(Octree& tree, const Scene& scene, const View& view, const Field& field) {
    // A leaf halfway to the maximum range spans a few cells.
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    AngularCells cells(view, field.leaf_m(middle) / middle / cells_per_leaf);
    std::vector<SeenFacet> seen;
    std::uint64_t dropped = 0;
    const auto take = [&](const Run& run) { dropped += cells.see(run, field, seen); };
    Search(tree, field, take).run();
    cells.close_holes();
    if (view.shape == ViewShape::cone) cells.mask_cone(view);
    std::vector<Sample> items;
    std::vector<std::uint32_t> beams;
    items.reserve(2 * seen.size());
    beams.reserve(2 * seen.size());
    for (const SeenFacet& facet : seen) {
        dropped += cells.pieces(facet, [&](int beam, const SeenPiece& piece) {
            Sample& sample = items.emplace_back();
            sample.position = facet.centre + piece.u * facet.edge_u + piece.v * facet.edge_v;
            sample.edge_u = piece.half_u * facet.edge_u;
            sample.edge_v = piece.half_v * facet.edge_v;
            sample.normal = facet.normal;
            sample.height_m = -facet.normal.dot(facet.centre);
            sample.area_m2 = piece.share * facet.area_m2;
            sample.material = scene.triangle_material[facet.triangle];
            sample.instance = scene.triangle_instance[facet.triangle];
            beams.push_back(static_cast<std::uint32_t>(beam));
        });
    }
    Samples samples = sorted_by_beam(items, beams, view.beams);
    samples.dropped = dropped;
    return samples;
}

}  // namespace sonarsim
