#include "visibility/octree/leaf_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/groups.h"
#include "visibility/octree/depth_buffer.h"
#include "visibility/octree/projection.h"

namespace sonarsim {

namespace {

/// Along a sight line a surface deviates by its thickness over the cosine of incidence. The cosine
/// is limited to this, since it falls to zero behind the limb of a sphere.
constexpr float least_sight_cosine = 0.1F;

/// Positions are floats; their error is some roundings of 6e-8 of the range.
constexpr float sight_rounding = 1e-6F;

/// True if the plane that a sight line met lies in front of the sample. `towards` is the vector
/// from the sonar to the sample in local axes.
bool hides(const Facet& facet, const LocalPose& pose, const Eigen::Vector3f& towards,
           const Sample& sample, float thickness_m, float rounding_m) {
    // A sample in that plane belongs to the same surface, even if it is so nearly edge-on that
    // ranges are meaningless.
    const float height = facet.normal.dot(pose.position - facet.vertex);
    const float along = facet.normal.dot(towards);
    if (std::fabs(height + along) <= thickness_m + rounding_m) return false;
    const float range_m = sample.position.norm();
    const float cosine = std::max(sample.height_m / range_m, least_sight_cosine);
    const float nearer = 1.0F - (thickness_m / cosine + rounding_m) / range_m;
    return std::fabs(height) < nearer * std::fabs(along);
}

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

/// Draws a facet, and once for each end if it crosses the half plane behind the sonar, where
/// azimuths jump.
void add(const ProjectedFacet& facet, const ProjectionGrid& grid, DepthBuffer& depths,
         std::vector<ProjectedFacet>& facets) {
    depths.draw(facet);
    facets.push_back(facet);
    // This near the axis the facet covers all azimuths, and its ends are meaningless.
    if (facet.half_beams > 0.5F * grid.beams_per_revolution) return;
    for (const float turn : {-grid.beams_per_revolution, grid.beams_per_revolution}) {
        ProjectedFacet other = facet;
        other.beam += turn;
        if (other.beam + other.half_beams <= 0.0F ||
            other.beam - other.half_beams >= static_cast<float>(grid.beams))
            continue;
        depths.draw(other);
        facets.push_back(other);
    }
}

LeafParts find_parts(const Octree& tree, const Scene& scene, const PreparedView& prepared) {
    const View& view = prepared.view;
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    const ProjectionGrid grid = projection_grid(prepared, prepared.leaf_size.at(middle) / middle);
    DepthBuffer depths(grid);
    std::vector<ProjectedFacet> facets;
    LeafParts parts;
    tree.visit_leaves(prepared,
                      [&](const Visit&, float edge_m, std::span<const LeafFacet> leaf_facets) {
                          for (const LeafFacet& leaf : leaf_facets) {
                              ProjectedFacet facet;
                              const Projection result = project(leaf, edge_m, grid, facet);
                              parts.dropped += result == Projection::on_axis;
                              if (result != Projection::in_view) continue;
                              add(facet, grid, depths, facets);
                          }
                      });
    if (view.shape == ViewShape::cone) depths.mask_cone(view.azimuth_rad);

    parts.samples.reserve(2 * facets.size());
    parts.beams.reserve(2 * facets.size());
    parts.thickness_m.reserve(2 * facets.size());
    const auto most = static_cast<float>(view.beams - 1);
    for (const ProjectedFacet& facet : facets) {
        const bool clear = depths.is_fully_visible(facet);
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

}  // namespace

std::vector<std::uint32_t> in_sight(const Caster& caster, const LocalPose& pose, float reach_m,
                                    std::span<const Sample> samples,
                                    std::span<const float> thickness_m) {
    std::vector<Eigen::Vector3f> directions(samples.size());
    std::vector<std::uint32_t> met(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        directions[i] = pose.rotation * samples[i].position.normalized();
    caster.cast(pose.position, directions, reach_m, met);
    std::vector<std::uint32_t> seen;
    seen.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool hidden = met[i] != Caster::nothing &&
                            hides(caster.facet(met[i]), pose, pose.rotation * samples[i].position,
                                  samples[i], thickness_m[i], sight_rounding * reach_m);
        if (!hidden) seen.push_back(static_cast<std::uint32_t>(i));
    }
    return seen;
}

Samples leaf_samples(const Octree& tree, const Caster& caster, const Scene& scene,
                     const PreparedView& prepared) {
    const View& view = prepared.view;
    const LeafParts parts = find_parts(tree, scene, prepared);
    const LocalPose pose{prepared.volume.R_sensor_local().transpose(),
                         prepared.volume.position().cast<float>()};
    const std::vector<std::uint32_t> seen = in_sight(
        caster, pose, static_cast<float>(view.range_max_m), parts.samples, parts.thickness_m);
    std::vector<std::uint32_t> beams;
    beams.reserve(seen.size());
    for (const std::uint32_t k : seen)
        beams.push_back(parts.beams[k]);
    Groups by_beam = sort_into_groups(beams, view.beams);
    Samples samples;
    samples.items.reserve(seen.size());
    for (const std::uint32_t k : by_beam.items)
        samples.items.push_back(parts.samples[seen[k]]);
    samples.beam_begin = std::move(by_beam.begin);
    samples.dropped = parts.dropped;
    return samples;
}

}  // namespace sonarsim
