#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "visibility/octree/leaf_samples.h"

namespace sonarsim {

namespace {

constexpr float gap_leaves = 4.0F;

struct Vote {
    std::uint64_t pixel;  ///< index of azimuth and elevation, azimuth first
    int beam;
    float range_m;
    float leaf_m;
    Eigen::Vector3f centre;  ///< sensor frame
    Eigen::Vector3f normal;
    std::uint32_t triangle;
};

}  // namespace

Samples literal_samples(const Octree& tree, const Scene& scene, const PreparedView& prepared) {
    const View& view = prepared.view;
    const Eigen::Matrix3f& R_sensor_local = prepared.volume.R_sensor_local();
    // Pixel height: a leaf at half the greatest range.
    const auto middle = static_cast<float>(0.5 * view.range_max_m);
    const double row_height = prepared.leaf_size.at(middle) / middle;
    // Pixel width: a beam of a fan; the wide beams of other views are divided into square pixels.
    const bool fan = view.shape == ViewShape::fan;
    std::vector<Vote> votes;
    Samples samples;
    tree.visit_leaves(prepared, [&](const Visit& cube, float edge_m,
                                    std::span<const LeafFacet> facets) {
        const Eigen::Vector3f centre = R_sensor_local * cube.centre;
        const double range = centre.norm();
        if (!(range > 0.0)) {
            ++samples.dropped;  // the leaf's centre is at the sonar and has no direction
            return;
        }
        const int beam = beam_of(view, centre);
        if (beam < 0) return;
        const double azimuth = arctan2(centre.y(), centre.x()) + 0.5 * view.azimuth_rad;
        const double elevation = arcsin(centre.z() / range) + 0.5 * view.elevation_rad;
        const auto column = fan ? beam : static_cast<int>(std::max(azimuth, 0.0) / row_height);
        const auto row = static_cast<int>(std::max(elevation, 0.0) / row_height);
        const Eigen::Vector3f normal = R_sensor_local * facets[0].normal;
        votes.push_back(
            {static_cast<std::uint64_t>(column) << 32U | static_cast<std::uint64_t>(row), beam,
             static_cast<float>(range), edge_m, centre,
             normal.dot(centre) > 0.0F ? Eigen::Vector3f(-normal) : normal, facets[0].triangle});
    });
    std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
        return a.pixel != b.pixel ? a.pixel < b.pixel : a.range_m < b.range_m;
    });
    samples.beam_begin.assign(view.beams + 1, 0);
    bool kept = false;
    for (std::size_t k = 0; k < votes.size(); ++k) {
        const Vote& vote = votes[k];
        const bool first = k == 0 || votes[k - 1].pixel != vote.pixel;
        kept = first || (kept && vote.range_m - votes[k - 1].range_m <= gap_leaves * vote.leaf_m);
        if (!kept) continue;
        Sample& sample = samples.items.emplace_back();
        sample.position = vote.centre;
        sample.edge_u = sample.edge_v = Eigen::Vector3f::Zero();
        sample.normal = vote.normal;
        sample.height_m = -vote.normal.dot(vote.centre);
        sample.area_m2 = 1.0F;
        sample.material = scene.triangle_material[vote.triangle];
        sample.instance = scene.triangle_instance[vote.triangle];
        ++samples.beam_begin[vote.beam + 1];
    }
    for (int b = 0; b < view.beams; ++b)
        samples.beam_begin[b + 1] += samples.beam_begin[b];
    return samples;
}

}  // namespace sonarsim
