#pragma once

#include "input/scene/scene.h"
#include "simulate/visibility/engine.h"
#include "support/test.h"

namespace sonarsim::test {

/// The image of a view's samples, [beams, range_bins]: the mean over each bin (Eq. 9), with every
/// sample a box in range.
inline std::vector<double> mean_echoes(const Scene& scene, const View& view,
                                       const Samples& samples) {
    const auto count = static_cast<std::size_t>(view.range_bins);
    std::vector<double> image;
    image.reserve(view.beams * count);
    for (int beam = 0; beam < view.beams; ++beam) {
        std::vector<double> weight(count), echo(count);
        for (const Sample& sample : samples.beam(beam)) {
            const auto range = static_cast<double>(sample.position.norm());
            const double half = static_cast<double>(std::fabs(sample.position.dot(sample.edge_u)) +
                                                    std::fabs(sample.position.dot(sample.edge_v))) /
                                range;
            // All lengths in bins; the sample spreads over those that it overlaps.
            const double from = (range - half - view.range_min_m) / view.bin_m();
            const double to =
                std::max((range + half - view.range_min_m) / view.bin_m(), from + 1e-6);
            const double density = static_cast<double>(sample.area_m2) / (to - from);
            const double intensity =
                static_cast<double>(scene.materials[sample.material].reflection) *
                static_cast<double>(sample.strength) * static_cast<double>(sample.height_m) / range;
            for (int i = static_cast<int>(std::max(from, 0.0));
                 i < std::min(to, 1.0 * view.range_bins); ++i) {
                const double overlap = std::min(to, i + 1.0) - std::max(from, 1.0 * i);
                weight[i] += density * overlap;
                echo[i] += density * overlap * intensity;
            }
        }
        for (std::size_t i = 0; i < count; ++i)
            image.push_back(weight[i] > 0.0 ? echo[i] / weight[i] : 0.0);
    }
    return image;
}

}  // namespace sonarsim::test
