#include "product/range_bias.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "product/detect_return.h"

namespace sonarsim {

namespace {

constexpr int longest_bins = 48;  // longer surfaces have the same bias
constexpr int phases = 8;         // places of the surface's start within its bin
constexpr int lengths_per_bin = 4;
constexpr double most_delay_bins = 16.0;
constexpr double tail = 7.0;  // mean delays after which no echo is counted

double arrived_from_start(double x, int k, double lambda_m) {
    if (x <= 0.0) return 0.0;
    return (x - lambda_m / k * (1.0 - exponential(-k * x / lambda_m))) / k;
}

double arrived(double x, int k, double length_m, double lambda_m) {
    return arrived_from_start(x, k, lambda_m) - arrived_from_start(x - length_m, k, lambda_m);
}

/// The expected beam of a surface that begins at `begin_m`, in bins from range 0 on.
std::vector<double> expected_beam(double begin_m, double length_m, double lambda_m, double bin_m) {
    const double end_m = begin_m + length_m + tail * lambda_m;
    // A beam is mostly dark, so that its mean is low.
    std::vector<double> beam(10 * static_cast<std::size_t>(std::ceil(end_m / bin_m)) + 10);
    double count = 0.0;
    double brightness = 0.0;
    for (std::size_t i = 0; static_cast<double>(i) * bin_m < end_m; ++i) {
        const double x = static_cast<double>(i + 1) * bin_m - begin_m;
        const double next_count = arrived(x, 1, length_m, lambda_m);
        const double next_brightness = arrived(x, 2, length_m, lambda_m);
        // Bins that a thousandth of the echoes or fewer reach stay empty.
        if (next_count - count > 1e-3 * std::min(length_m, bin_m))
            beam[i] = (next_brightness - brightness) / (next_count - count);
        count = next_count;
        brightness = next_brightness;
    }
    return beam;
}

/// The bias by length in bins, up to the longest run that occurs.
std::vector<double> table(double lambda_m, double bin_m) {
    std::vector<double> sums(1);
    std::vector<int> counts(1);
    for (int n = 0; n <= longest_bins * lengths_per_bin; ++n) {
        const double length_m = std::max(n * bin_m / lengths_per_bin, 1e-3 * bin_m);
        for (int phase = 0; phase < phases; ++phase) {
            const double begin_m = (phase + 0.5) / phases * bin_m;
            const DetectedReturn run =
                detect_return(expected_beam(begin_m, length_m, lambda_m, bin_m));
            const auto bins = static_cast<std::size_t>(run.end - run.begin);
            sums.resize(std::max(sums.size(), bins + 1));
            counts.resize(sums.size());
            sums[bins] += 0.5 * (run.begin + run.end) * bin_m - (begin_m + 0.5 * length_m);
            ++counts[bins];
        }
    }
    // A length that does not occur gets the bias of the next longer one.
    double next = sums.back() / counts.back();
    for (std::size_t bins = sums.size(); bins-- > 0;) {
        if (counts[bins] > 0) next = sums[bins] / counts[bins];
        sums[bins] = next;
    }
    return sums;
}

}  // namespace

std::vector<double> range_bias_m(double lambda_m, double bin_m, int bins) {
    if (!(lambda_m > 0.0) || lambda_m >= bins * bin_m) return {};
    // When delays span many bins, the bin size does not matter: larger steps save time.
    const double step_m = std::max(bin_m, lambda_m / most_delay_bins);
    const std::vector<double> by_step = table(lambda_m, step_m);
    std::vector<double> offsets(bins + 1);
    for (int n = 0; n <= bins; ++n) {
        const auto step = static_cast<std::size_t>(std::lround(n * bin_m / step_m));
        offsets[n] = by_step[std::min(step, by_step.size() - 1)];
    }
    return offsets;
}

}  // namespace sonarsim
