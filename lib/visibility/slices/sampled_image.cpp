#include "visibility/slices/sampled_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/overlapped_bins.h"
#include "visibility/range_extent.h"

namespace sonarsim {

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
        for (const Sample& sample : samples.beam(beam)) {
            const Interval box = bins_of(view, sample);
            const float to = std::max(box.to, box.from + 1e-5F);
            const float intensity = scene.materials[sample.material].reflection * sample.height_m /
                                    sample.position.norm();
            const OverlappedBins covered(box.from, to, view.range_bins);
            for (int bin = covered.begin; bin < covered.end; ++bin) {
                const float area = sample.area_m2 * covered.overlap(bin) / (to - box.from);
                const std::size_t k = static_cast<std::size_t>(beam) * range_bins + bin;
                image.area[k] += area;
                image.echo[k] += area * intensity;
            }
        }
    }
    return image;
}

}  // namespace sonarsim
