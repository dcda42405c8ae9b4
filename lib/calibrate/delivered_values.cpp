#include "calibrate/delivered_values.h"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "calibrate/patches.h"

namespace sonarsim {

namespace {

constexpr std::size_t least_patches_of_offset = 24;
constexpr double least_mean_of_offset = 6.0;
// Patches whose means differ by less than this share (standard deviation) do not determine a line.
constexpr double least_spread_of_means = 0.1;
// The variance that rounding adds to values of whole steps.
constexpr double rounding = 1.0 / 12.0;

/// Sums for a line of deviation against mean, with weights 1 / mean^2.
struct LineSums {
    double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;

    void add(double weight, double mean, double deviation) {
        const double own = weight / (mean * mean);
        w += own;
        x += own * mean;
        y += own * deviation;
        xx += own * mean * mean;
        xy += own * mean * deviation;
    }
    /// The line reaches 0 at -offset.
    double offset() const {
        const double slope = (w * xy - x * y) / (w * xx - x * x);
        return (y - slope * x) / w / slope;
    }
};

}  // namespace

std::optional<int> bits_of(const std::vector<RecordedPing>& pings, double full_value) {
    std::uint64_t step = 0;
    for (const RecordedPing& ping : pings) {
        for (const float value : ping.values) {
            if (!(value >= 0.0F && value < 1e9F) || value != std::floor(value)) return {};
            step = std::gcd(step, static_cast<std::uint64_t>(value));
        }
    }
    if (step == 0) return {};
    const double count = full_value / static_cast<double>(step) + 1.0;
    for (int bits = 1; bits <= 24; ++bits) {
        if (std::fabs(count - static_cast<double>(std::uint64_t{1} << bits)) < 1e-6 * count)
            return bits;
    }
    return {};
}

std::optional<Bounded> fit_offset(const std::vector<RecordedPing>& pings, double full_value,
                                  const std::vector<bool>& places, OffsetUnits units) {
    const bool has_steps = full_value > 15.0;
    const std::vector<PatchMoments> patches =
        at_places(patch_moments(pings, full_value, [](double v, int) { return v; }), places);
    const std::vector<std::size_t> even =
        speckle_patches(patches, has_steps ? least_mean_of_offset : 0.0);
    if (even.size() < least_patches_of_offset) return {};
    const auto deviation = [&](const PatchMoments& p) {
        const double along = p.along_beams[patch_lags - 1];
        const double variance = std::isfinite(along) ? along : p.variance;
        return std::sqrt(std::max(variance - (has_steps ? rounding : 0.0), 0.0));
    };
    double sum = 0.0, square = 0.0;
    for (const std::size_t k : even) {
        sum += patches[k].mean_value;
        square += patches[k].mean_value * patches[k].mean_value;
    }
    const double mean = sum / static_cast<double>(even.size());
    const double spread = square / static_cast<double>(even.size()) / (mean * mean) - 1.0;
    if (spread < least_spread_of_means * least_spread_of_means) return {};
    const PatchGrid grid = speckle_grid(pings.front());
    const int count = units == OffsetUnits::ranges ? grid.rows : grid.places();
    return bootstrap(count, [&](const std::vector<double>& weights) {
        LineSums line;
        for (const std::size_t k : even) {
            const PatchMoments& p = patches[k];
            const int unit = units == OffsetUnits::ranges ? p.row / grid.size.ranges : p.place;
            line.add(weights[static_cast<std::size_t>(unit)], p.mean_value, deviation(p));
        }
        return line.offset() / full_value;
    });
}

}  // namespace sonarsim
