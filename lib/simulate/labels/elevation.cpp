#include "simulate/labels/elevation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The variance of sin(theta) in a patch at one range.
double variance_at_one_range(const EchoPatch& patch) {
    const auto [range, d] = arrival_of(patch.position);
    const float u = d.dot(patch.edge_u);
    const float v = d.dot(patch.edge_v);
    // Over the parallelogram, (s, t) in [-1, 1]^2, sin(theta) = z / r changes by
    // (dz - (z / r) dr) / r along an edge. The part that is in proportion to range does not spread
    // at one range.
    const double sine_u = (patch.edge_u.z() - d.z() * u) / range;
    const double sine_v = (patch.edge_v.z() - d.z() * v) / range;
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    const double with = sine_u * u + sine_v * v;
    const double explained = depth_2 > 0.0 ? with * with / depth_2 : 0.0;
    return std::max(sine_u * sine_u + sine_v * sine_v - explained, 0.0) / 3.0;
}

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Bins are computed in blocks of this many.
constexpr int block = 16;

/// Elevations and spreads of at most a block of bins, from the echo and its moments. Two loops
/// without branches, so that they vectorise.
void find_bins(const double* __restrict echo, const double* __restrict first,
               const double* __restrict second, int count, float* __restrict elevation,
               float* __restrict spread) {
    std::array<float, block> sines, cosines;
    for (int i = 0; i < count; ++i) {
        const bool occupied = echo[i] > 0.0;
        const double total = occupied ? echo[i] : 1.0;
        const double sine = std::min(std::max(first[i] / total, -1.0), 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        // d(theta) = d(sin theta) / cos(theta), limited to a half circle where cos is 0.
        const double deviation = std::sqrt(std::max(second[i] / total - sine * sine, 0.0));
        const double least = std::max(std::max(cosine, deviation / pi), 1e-9);
        sines[i] = static_cast<float>(occupied ? sine : none);
        cosines[i] = static_cast<float>(cosine);
        spread[i] = static_cast<float>(occupied ? deviation / least : none);
    }
    for (int i = 0; i < count; ++i) {
        const float angle = arctan2_float(sines[i], cosines[i]);
        elevation[i] = std::isnan(sines[i]) ? none : angle;
    }
}

}  // namespace

ElevationFinder::ElevationFinder(const RangeBins& bins, int rows) : sums_(rows, bins.count) {}

void ElevationFinder::begin(const EchoPatch& patch, const RangePath& path) {
    const Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
    rise_m_ = patch.position.dot(axis);
    slope_ = path.per_range.dot(axis);
    variance_at_range_ = variance_at_one_range(patch);
}

void ElevationFinder::cover(const CoveredBins& covered) {
    const auto sine_at = [&](int k) {
        return std::clamp((rise_m_ + slope_ * covered.way[k]) / covered.range_m[k], -1.0, 1.0);
    };
    for (int k = 0; k < covered.whole; ++k) {
        const double enters = sine_at(k);
        const double leaves = sine_at(k + 1);
        const double along = leaves - enters;
        mean_[k] = 0.5 * (enters + leaves);
        square_[k] = mean_[k] * mean_[k] + along * along / 12.0 + variance_at_range_;
    }
}

void ElevationFinder::add(std::uint32_t row, double echo, const CoveredBins& covered) {
    const auto [to_echo, to_first, to_second] = sums_.at(row, covered);
    double* const __restrict sum = to_echo;
    double* const __restrict first = to_first;
    double* const __restrict second = to_second;
    for (int k = 0; k < covered.whole; ++k) {
        const double part = echo * covered.share[k];
        sum[k] += part;
        first[k] += part * mean_[k];
        second[k] += part * square_[k];
    }
}

void ElevationFinder::find(std::uint32_t row, std::span<float> elevation_rad,
                           std::span<float> spread_rad) {
    const BinSumRows<3>::Row sums = sums_.row(row);
    const auto [echo, first, second] = sums.of;
    // Most blocks hold water alone and are skipped.
    for (int from = sums.first; from < sums.last; from += block) {
        const int count = std::min(block, sums.last - from);
        const std::span<const double> echoes(echo + from, count);
        if (std::ranges::all_of(echoes, [](double e) { return e == 0.0; })) continue;
        find_bins(echo + from, first + from, second + from, count, &elevation_rad[from],
                  &spread_rad[from]);
    }
    sums_.clear(row);
}

}  // namespace sonarsim
