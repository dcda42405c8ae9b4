#include "ping/elevation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// A footprint as range sees it: r and sin(theta) of its centre, and by how much they change along
/// its half edges.
struct ElevationFootprint {
    double range_m, range_u, range_v;
    double sine, sine_u, sine_v;
};

ElevationFootprint elevation_footprint(const Sample& sample) {
    const double range = sample.position.norm();
    const Eigen::Vector3f d = sample.position / static_cast<float>(range);
    const double sine = d.z();
    const double u = d.dot(sample.edge_u);
    const double v = d.dot(sample.edge_v);
    // d(z / r) = (dz - (z / r) dr) / r
    return {range,
            u,
            v,
            sine,
            (sample.edge_u.z() - sine * u) / range,
            (sample.edge_v.z() - sine * v) / range};
}

}  // namespace

void ElevationFinder::add(const Sample& sample) {
    const ElevationFootprint f = elevation_footprint(sample);
    const double reflection = materials_[sample.material].reflection;
    const double echo = sample.area_m2 * reflection * std::min(sample.height_m / f.range_m, 1.0);
    // Over the parallelogram range and sine are linear in (s, t) in [-1, 1]^2: how the sine goes
    // with range, and what it varies besides.
    const double depth_2 = f.range_u * f.range_u + f.range_v * f.range_v;
    const double with = f.sine_u * f.range_u + f.sine_v * f.range_v;
    const double slope = depth_2 > 0.0 ? with / depth_2 : 0.0;
    const double sine_2 = f.sine_u * f.sine_u + f.sine_v * f.sine_v;
    const double besides = std::max(sine_2 - slope * with, 0.0) / 3.0;

    const double per_bin = 1.0 / bins_.bin_m;
    const double centre = (f.range_m - bins_.min_m) * per_bin;
    const double half = std::max((std::fabs(f.range_u) + std::fabs(f.range_v)) * per_bin, 1e-3);
    const double low = std::max(centre - half, 0.0);
    const double high = std::min(centre + half, static_cast<double>(bins_.count));
    if (!(low < high && echo > 0.0)) return;
    const double slope_per_bin = slope * bins_.bin_m;
    for (auto i = static_cast<int>(low); i < bins_.count && i < high; ++i) {
        const double from = std::max(low, static_cast<double>(i));
        const double to = std::min(high, i + 1.0);
        const double part = echo * (to - from) / (2.0 * half);
        const double sine = f.sine + slope_per_bin * (0.5 * (from + to) - centre);
        const double along = slope_per_bin * (to - from);
        Moments& m = moments_[i];
        m.echo += part;
        m.first += part * sine;
        m.second += part * (sine * sine + along * along / 12.0 + besides);
    }
}

void ElevationFinder::find(std::span<const Sample> samples, std::span<float> elevation_rad,
                           std::span<float> spread_rad) {
    moments_.assign(bins_.count, {});
    for (const Sample& sample : samples)
        add(sample);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    for (int i = 0; i < bins_.count; ++i) {
        const Moments& m = moments_[i];
        elevation_rad[i] = none;
        spread_rad[i] = none;
        if (!(m.echo > 0.0)) continue;
        const double sine = std::clamp(m.first / m.echo, -1.0, 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        const double variance = std::max(m.second / m.echo - sine * sine, 0.0);
        elevation_rad[i] = arctan2_float(static_cast<float>(sine), static_cast<float>(cosine));
        // d theta = d sin(theta) / cos(theta); no more than the whole circle where cos is 0.
        const double spread = std::sqrt(variance);
        spread_rad[i] = static_cast<float>(spread / std::max(cosine, std::max(spread / pi, 1e-9)));
    }
}

}  // namespace sonarsim
