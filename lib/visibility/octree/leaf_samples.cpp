#include "visibility/octree/leaf_samples.h"

#include <algorithm>
#include <utility>

#include "core/groups.h"
#include "visibility/octree/depth_buffer.h"
#include "visibility/octree/projection.h"
#include "visibility/octree/search.h"
#include "visibility/octree/sight_lines.h"

namespace sonarsim {

namespace {

/// The visible parts of the leaves, in the order of the leaves.
struct LeafParts {
    std::vector<Sample> samples;
    std::vector<std::uint32_t> beams;  ///< beam of each sample
    std::vector<float> thickness_m;    ///< largest distance of its surface from its plane
    std::uint64_t dropped = 0;
};

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

LeafParts find_parts(Octree& tree, const Scene& scene, const View& view, const ViewVolume& volume,
                     const LeafSize& leaf_size) {
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    const ProjectionGrid grid = projection_grid(view, leaf_size.at(middle) / middle);
    DepthBuffer depths(grid);
    std::vector<ProjectedFacet> facets;
    std::vector<Outline> outlines;
    LeafParts parts;
    const auto take = [&](const LeafRun& run) {
        const std::size_t first = facets.size();
        outlines.clear();
        parts.dropped += project(run, volume, grid, facets, outlines);
        for (std::size_t k = 0; k < outlines.size(); ++k)
            depths.draw(facets[first + k], outlines[k]);
    };
    Search(tree, volume, leaf_size, take).run();
    if (view.shape == ViewShape::cone) depths.mask_cone(view.azimuth_rad);

    parts.samples.reserve(2 * facets.size());
    parts.beams.reserve(2 * facets.size());
    parts.thickness_m.reserve(2 * facets.size());
    const auto most = static_cast<float>(view.beams - 1);
    for (const ProjectedFacet& facet : facets) {
        const bool clear = depths.is_clear(facet);
        const int first = static_cast<int>(std::clamp(facet.beam - facet.half_beams, 0.0F, most));
        const int last = static_cast<int>(std::clamp(facet.beam + facet.half_beams, 0.0F, most));
        for (int beam = first; beam <= last; ++beam) {
            VisiblePart part;
            const auto visibility = depths.visible_part(facet, beam, clear, part);
            parts.dropped += visibility == DepthBuffer::Visibility::too_small;
            if (visibility != DepthBuffer::Visibility::visible) continue;
            parts.samples.push_back(sample_of(facet, part, scene));
            parts.beams.push_back(static_cast<std::uint32_t>(beam));
            parts.thickness_m.push_back(facet.thickness_m);
        }
    }
    return parts;
}

/// Drops samples that other surface hides, as sight lines show.
void drop_hidden(const Caster& caster, const View& view, const ViewVolume& volume,
                 LeafParts& parts) {
    const LocalPose pose{volume.R_sensor_local().transpose(), volume.position().cast<float>()};
    const std::vector<std::uint32_t> seen = in_sight(
        caster, pose, static_cast<float>(view.range_max_m), parts.samples, parts.thickness_m);
    for (std::size_t k = 0; k < seen.size(); ++k) {
        parts.samples[k] = parts.samples[seen[k]];
        parts.beams[k] = parts.beams[seen[k]];
    }
    parts.samples.resize(seen.size());
    parts.beams.resize(seen.size());
}

}  // namespace

Samples leaf_samples(Octree& tree, const Caster& caster, const Scene& scene, const View& view,
                     const ViewVolume& volume, const LeafSize& leaf_size) {
    LeafParts parts = find_parts(tree, scene, view, volume, leaf_size);
    drop_hidden(caster, view, volume, parts);
    Groups by_beam = sort_into_groups(parts.beams, view.beams);
    Samples samples;
    samples.items.reserve(parts.samples.size());
    for (const std::uint32_t k : by_beam.items)
        samples.items.push_back(parts.samples[k]);
    samples.beam_begin = std::move(by_beam.begin);
    samples.dropped = parts.dropped;
    return samples;
}

}  // namespace sonarsim
