#include "visibility/octree/leaf_samples.h"

#include <algorithm>
#include <utility>

#include "core/groups.h"
#include "visibility/octree/depth_buffer.h"
#include "visibility/octree/projection.h"
#include "visibility/octree/search.h"

namespace sonarsim {

namespace {

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
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    const ProjectionGrid grid = projection_grid(view, leaf_size.at(middle) / middle);
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
    Groups by_beam = sort_into_groups(beams, view.beams);
    Samples samples;
    samples.items.reserve(items.size());
    for (const std::uint32_t k : by_beam.items)
        samples.items.push_back(items[k]);
    samples.beam_begin = std::move(by_beam.begin);
    samples.dropped = dropped;
    return samples;
}

}  // namespace sonarsim
