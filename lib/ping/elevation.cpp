#include "ping/elevation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/elementary.h"
#include "ping/footprint.h"

namespace sonarsim {

namespace {

/// A footprint as range sees it.
struct ElevationFootprint {
    double range_m, z_m;       ///< of its centre
    double before_m, after_m;  ///< how far its range reaches from there
    double depth_m;            ///< spanned by its half edges
    double bend;               ///< squared length of the path of `path_z` per metre of range
    double path_z;             ///< rise per metre of range, where range grows fastest
    double besides;            ///< variance of sin(theta) at one range
};

ElevationFootprint elevation_footprint(const Sample& sample) {
    const float range = sample.position.norm();
    const Eigen::Vector3f d = sample.position / range;
    const float u = d.dot(sample.edge_u);
    const float v = d.dot(sample.edge_v);
    const RangeExtent along_u = extent_of(sample.edge_u.squaredNorm(), std::fabs(u), range);
    const RangeExtent along_v = extent_of(sample.edge_v.squaredNorm(), std::fabs(v), range);
    // Over the parallelogram, (s, t) in [-1, 1]^2, sin(theta) = z / r changes by
    // (dz - (z / r) dr) / r along an edge. What goes with range is not spread at one range.
    const double sine_u = (sample.edge_u.z() - d.z() * u) / range;
    const double sine_v = (sample.edge_v.z() - d.z() * v) / range;
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    const double with = sine_u * u + sine_v * v;
    const double explained = depth_2 > 0.0 ? with * with / depth_2 : 0.0;
    const double spread = std::max(sine_u * sine_u + sine_v * sine_v - explained, 0.0) / 3.0;
    Eigen::Vector3f path = Eigen::Vector3f::Zero();
    if (depth_2 > 0.0) {
        path = (u * sample.edge_u + v * sample.edge_v) / static_cast<float>(depth_2);
    }
    return {.range_m = range,
            .z_m = sample.position.z(),
            .before_m = along_u.before + along_v.before,
            .after_m = along_u.after + along_v.after,
            .depth_m = std::fabs(u) + std::fabs(v),
            .bend = path.squaredNorm(),
            .path_z = path.z(),
            .besides = spread};
}

/// sin(theta) of the footprint at range r. On its way p + t e, where d . e = 1, the range is
/// r^2 = r_0^2 + 2 r_0 t + e^2 t^2: a flat piece may span many bins, and its sine is not linear.
double sine_at(const ElevationFootprint& f, double r) {
    const double more = (r - f.range_m) * (r + f.range_m);
    const double root = std::sqrt(std::max(f.range_m * f.range_m + f.bend * more, 0.0));
    const double t = std::clamp(more / (f.range_m + root), -f.depth_m, f.depth_m);
    return std::clamp((f.z_m + f.path_z * t) / r, -1.0, 1.0);
}

}  // namespace

void ElevationFinder::add(const Sample& sample) {
    const ElevationFootprint f = elevation_footprint(sample);
    const double reflection = materials_[sample.material].reflection;
    const double echo = sample.area_m2 * reflection * std::min(sample.height_m / f.range_m, 1.0);
    const double per_bin = 1.0 / bins_.bin_m;
    const double centre = (f.range_m - bins_.min_m) * per_bin;
    // As in accumulate(): a footprint without depth still needs a width.
    const double first = centre - std::max(f.before_m * per_bin, 1e-3);
    const double last = centre + std::max(f.after_m * per_bin, 1e-3);
    const double low = std::max(first, 0.0);
    const double high = std::min(last, static_cast<double>(bins_.count));
    if (!(low < high && echo > 0.0)) return;
    const double echo_per_bin = echo / (last - first);
    first_bin_ = std::min(first_bin_, static_cast<int>(low));
    last_bin_ = std::max(last_bin_, std::min(static_cast<int>(high) + 1, bins_.count));
    double sine_from = sine_at(f, bins_.min_m + low * bins_.bin_m);
    for (auto i = static_cast<int>(low); i < bins_.count && i < high; ++i) {
        const double from = std::max(low, static_cast<double>(i));
        const double to = std::min(high, i + 1.0);
        const double sine_to = sine_at(f, bins_.min_m + to * bins_.bin_m);
        const double part = echo_per_bin * (to - from);
        const double sine = 0.5 * (sine_from + sine_to);
        const double along = sine_to - sine_from;
        Moments& m = moments_[i];
        m.echo += part;
        m.first += part * sine;
        m.second += part * (sine * sine + along * along / 12.0 + f.besides);
        sine_from = sine_to;
    }
}

void ElevationFinder::find(std::span<const Sample> samples, std::span<float> elevation_rad,
                           std::span<float> spread_rad) {
    moments_.resize(bins_.count);
    first_bin_ = bins_.count;
    last_bin_ = 0;
    for (const Sample& sample : samples)
        add(sample);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::ranges::fill(elevation_rad, none);
    std::ranges::fill(spread_rad, none);
    for (int i = first_bin_; i < last_bin_; ++i) {
        const Moments m = std::exchange(moments_[i], {});
        if (!(m.echo > 0.0)) continue;
        const double sine = std::clamp(m.first / m.echo, -1.0, 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        elevation_rad[i] = arctan2_float(static_cast<float>(sine), static_cast<float>(cosine));
        // d(theta) = d(sin theta) / cos(theta); where cos is 0, no more than a half circle.
        const double spread = std::sqrt(std::max(m.second / m.echo - sine * sine, 0.0));
        spread_rad[i] = static_cast<float>(spread / std::max({cosine, spread / pi, 1e-9}));
    }
}

}  // namespace sonarsim
