#include "labels/elevation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "labels/range_path.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

/// The variance of sin(theta) in a patch at one range.
double spread_at_one_range(const EchoPatch& patch) {
    const auto [range, departure, d] = arrival_of(patch.position);
    const float u = d.dot(patch.edge_u);
    const float v = d.dot(patch.edge_v);
    // Over the parallelogram, (s, t) in [-1, 1]^2, sin(theta) = z / r changes by
    // (dz - (z / r) dr) / r along an edge. What goes with range is not spread at one range.
    const double sine_u = (patch.edge_u.z() - d.z() * u) / range;
    const double sine_v = (patch.edge_v.z() - d.z() * v) / range;
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    const double with = sine_u * u + sine_v * v;
    const double explained = depth_2 > 0.0 ? with * with / depth_2 : 0.0;
    return std::max(sine_u * sine_u + sine_v * sine_v - explained, 0.0) / 3.0;
}

}  // namespace

void ElevationFinder::add(const EchoPatch& patch) {
    const RangePath path = range_path(patch, Eigen::Vector3f::UnitZ());
    const double echo = patch.echo;
    if (!(echo > 0.0)) return;
    const double besides = spread_at_one_range(patch);
    const auto sine_at = [&](double r) { return std::clamp(rise_at(path, r) / r, -1.0, 1.0); };
    for_each_covered(path, bins_, sine_at, [&](const CoveredBins& covered) {
        first_bin_ = std::min(first_bin_, covered.first);
        last_bin_ = std::max(last_bin_, covered.first + covered.count);
        double* const __restrict sum = moments_.echo.data() + covered.first;
        double* const __restrict first = moments_.first.data() + covered.first;
        double* const __restrict second = moments_.second.data() + covered.first;
        for (int k = 0; k < covered.count; ++k) {
            const double part = echo * covered.share[k];
            const double sine = 0.5 * (covered.values[k] + covered.values[k + 1]);
            const double along = covered.values[k + 1] - covered.values[k];
            sum[k] += part;
            first[k] += part * sine;
            second[k] += part * (sine * sine + along * along / 12.0 + besides);
        }
    });
}

void ElevationFinder::find(std::span<const EchoPatch> patches, std::span<float> elevation_rad,
                           std::span<float> spread_rad) {
    const std::array sums{&moments_.echo, &moments_.first, &moments_.second};
    for (std::vector<double>* const sum : sums)
        sum->resize(bins_.count);
    first_bin_ = bins_.count;
    last_bin_ = 0;
    for (const EchoPatch& patch : patches)
        add(patch);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::ranges::fill(elevation_rad, none);
    std::ranges::fill(spread_rad, none);
    if (first_bin_ >= last_bin_) return;
    const double* const __restrict echo = moments_.echo.data();
    const double* const __restrict first = moments_.first.data();
    const double* const __restrict second = moments_.second.data();
    float* const __restrict elevation = elevation_rad.data();
    float* const __restrict spread = spread_rad.data();
    const auto find_bin = [=](int i) {
        const bool occupied = echo[i] > 0.0;
        const double total = occupied ? echo[i] : 1.0;
        const double sine = std::clamp(first[i] / total, -1.0, 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        const float angle = arctan2_float(static_cast<float>(sine), static_cast<float>(cosine));
        // d(theta) = d(sin theta) / cos(theta); where cos is 0, no more than a half circle.
        const double deviation = std::sqrt(std::max(second[i] / total - sine * sine, 0.0));
        const double least = std::max(std::max(cosine, deviation / pi), 1e-9);
        elevation[i] = occupied ? angle : none;
        spread[i] = occupied ? static_cast<float>(deviation / least) : none;
    };
    // Most bins between occupied ones hold water.
    constexpr int block = 16;
    for (int from = first_bin_; from < last_bin_; from += block) {
        const int end = std::min(from + block, last_bin_);
        if (std::all_of(echo + from, echo + end, [](double e) { return e == 0.0; })) continue;
        for (int i = from; i < end; ++i)
            find_bin(i);
    }
    for (std::vector<double>* const sum : sums)
        std::fill(sum->begin() + first_bin_, sum->begin() + last_bin_, 0.0);
}

}  // namespace sonarsim
