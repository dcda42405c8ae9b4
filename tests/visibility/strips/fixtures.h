#pragma once

#include "simulate/visibility/strips/strips.h"
#include "support/patches.h"

namespace sonarsim::test {

inline View fan_view(double azimuth_deg = 60.0, double elevation_deg = 20.0, int beams = 64) {
    return {radians(azimuth_deg), radians(elevation_deg), 0.2, 12.0, 256, beams, 0.03};
}

inline Samples visible(const SceneClusters& clusters, const View& view, const Pose& pose = {}) {
    return strips_surface(clusters.in_view(view, pose, {}), view);
}

inline Samples visible(const Scene& scene, const View& view, const Pose& pose = {}) {
    return visible(SceneClusters(scene), view, pose);
}

/// The solid angle that the samples of beams fill.
inline double filled_sr(const Samples& samples, int first_beam, int end_beam) {
    double sum = 0.0;
    for (std::uint32_t i = samples.beam_begin[first_beam]; i < samples.beam_begin[end_beam]; ++i) {
        const Sample& sample = samples.items[i];
        const auto r = static_cast<double>(sample.position.norm());
        sum += static_cast<double>(sample.area_m2 * sample.height_m) / (r * r * r);
    }
    return sum;
}
inline double filled_sr(const Samples& samples) {
    return filled_sr(samples, 0, static_cast<int>(samples.beam_begin.size()) - 1);
}

}  // namespace sonarsim::test
