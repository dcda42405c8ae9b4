#include "visibility/octree/leaf_samples.h"

#include <algorithm>

#include "visibility/octree/depth_buffer.h"
#include "visibility/octree/projection.h"
#include "visibility/octree/search.h"

namespace sonarsim {

namespace {

constexpr float pixels_per_leaf = 3.0F;

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

Sample sample_of(const ProjectedFacet& facet, const VisiblePart& part, const Scene& scene) {
    Sample sample;
    sample.position = facet.centre + part.u * facet.edge_u + part.v * facet.edge_v;
    sample.edge_u = part.half_u * facet.edge_u;
    sample.edge_v = part.half_v * facet.edge_v;
    sample.normal = facet.normal;
    sample.height_m = -facet.normal.dot(facet.centre);
    sample.area_m2 = part.share * facet.area_m2;
    sample.material = scene.triangle_material[facet.triangle];
    sample.instance = scene.triangle_instance[facet.triangle];
    return sample;
}

}  // namespace

Samples leaf_samples(Octree& tree, const Scene& scene, const View& view, const ViewVolume& volume,
                     const LeafSize& leaf_size) {
    // A leaf halfway to the greatest range spans a few pixels.
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    const ProjectionGrid grid =
        projection_grid(view, leaf_size.at(middle) / middle / pixels_per_leaf);
    DepthBuffer depths(grid);
    std::vector<ProjectedFacet> facets;
    std::vector<Outline> outlines;
    std::uint64_t dropped = 0;
    const auto take = [&](const LeafRun& run) {
        const std::size_t first = facets.size();
        outlines.clear();
        dropped += project(run, volume, grid, facets, outlines);
        for (std::size_t k = 0; k < outlines.size(); ++k)
            depths.draw(facets[first + k], outlines[k]);
    };
    Search(tree, volume, leaf_size, take).run();
    depths.close_holes();
    if (view.shape == ViewShape::cone) depths.mask_cone(view.azimuth_rad);

    std::vector<Sample> items;
    std::vector<std::uint32_t> beams;
    items.reserve(2 * facets.size());
    beams.reserve(2 * facets.size());
    const auto most = static_cast<float>(view.beams - 1);
    for (const ProjectedFacet& facet : facets) {
        const bool clear = depths.is_clear(facet);
        const int first = static_cast<int>(std::clamp(facet.beam - facet.half_beams, 0.0F, most));
        const int last = static_cast<int>(std::clamp(facet.beam + facet.half_beams, 0.0F, most));
        for (int beam = first; beam <= last; ++beam) {
            VisiblePart part;
            const auto visibility = depths.visible_part(facet, beam, clear, part);
            dropped += visibility == DepthBuffer::Visibility::too_small;
            if (visibility != DepthBuffer::Visibility::visible) continue;
            items.push_back(sample_of(facet, part, scene));
            beams.push_back(static_cast<std::uint32_t>(beam));
        }
    }
    Samples samples = sorted_by_beam(items, beams, view.beams);
    samples.dropped = dropped;
    return samples;
}

}  // namespace sonarsim
