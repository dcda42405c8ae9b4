#include "visibility/slices/sampled_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/overlapped_bins.h"
#include "visibility/range_extent.h"

namespace sonarsim {

namespace {

/// Adds a sample to the bins of its beam as an image has it: cut into pieces, each of them a box in
/// range (paper/footprint.h).
void add_pieces(const Sample& sample, float reflection, const View& view, std::span<float> area,
                std::span<float> echo) {
    const float range = sample.position.norm();
    const auto bin_m = static_cast<float>(view.bin_m());
    const auto range_min_m = static_cast<float>(view.range_min_m);
    const float depth_u = std::fabs(sample.position.dot(sample.edge_u)) / range;
    const float depth_v = std::fabs(sample.position.dot(sample.edge_v)) / range;
    const auto [u, v] = pieces_for_bins(depth_u, depth_v, range, bin_m);
    const Eigen::Vector3f half_u = sample.edge_u / u;
    const Eigen::Vector3f half_v = sample.edge_v / v;
    const RangeExtent along_u = extent_of(half_u.squaredNorm(), depth_u / u, range);
    const RangeExtent along_v = extent_of(half_v.squaredNorm(), depth_v / v, range);
    const float piece_m2 = sample.area_m2 / (u * v);
    for (int i = 0; i < static_cast<int>(u); ++i) {
        const float s = 2.0F * static_cast<float>(i) + 1.0F - u;
        for (int k = 0; k < static_cast<int>(v); ++k) {
            const float t = 2.0F * static_cast<float>(k) + 1.0F - v;
            const float at = (sample.position + s * half_u + t * half_v).norm();
            const float from = (at - along_u.before - along_v.before - range_min_m) / bin_m;
            const float end = (at + along_u.after + along_v.after - range_min_m) / bin_m;
            const float to = std::max(end, from + least_depth_bins);
            const float intensity = reflection * std::min(sample.height_m / at, 1.0F);
            const OverlappedBins covered(from, to, view.range_bins);
            for (int bin = covered.begin; bin < covered.end; ++bin) {
                const float in_bin = piece_m2 * covered.overlap(bin) / (to - from);
                area[bin] += in_bin;
                echo[bin] += in_bin * intensity;
            }
        }
    }
}

}  // namespace

Interval bins_of(const View& view, const Sample& sample) {
    const float range = sample.position.norm();
    const auto extent = [&](const Eigen::Vector3f& edge) {
        return extent_of(edge.squaredNorm(), std::fabs(sample.position.dot(edge)) / range, range);
    };
    const RangeExtent u = extent(sample.edge_u);
    const RangeExtent v = extent(sample.edge_v);
    const auto bin_m = static_cast<float>(view.bin_m());
    const float middle = range - static_cast<float>(view.range_min_m);
    return {(middle - u.before - v.before) / bin_m, (middle + u.after + v.after) / bin_m};
}

SampledImage image_of(const Scene& scene, const View& view, const Samples& samples) {
    const auto range_bins = static_cast<std::size_t>(view.range_bins);
    const std::size_t bins = range_bins * static_cast<std::size_t>(view.beams);
    SampledImage image{std::vector<float>(bins), std::vector<float>(bins)};
    for (int beam = 0; beam < view.beams; ++beam) {
        const std::size_t first = static_cast<std::size_t>(beam) * range_bins;
        for (const Sample& sample : samples.beam(beam))
            add_pieces(sample, scene.materials[sample.material].reflection, view,
                       std::span(image.area).subspan(first, range_bins),
                       std::span(image.echo).subspan(first, range_bins));
    }
    return image;
}

}  // namespace sonarsim
