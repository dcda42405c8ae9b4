#include "compare/figures/correlation.h"

#include <cmath>
#include <limits>
#include <vector>

namespace sonarsim {

namespace {

/// The values less their mean.
std::vector<double> centred(std::span<const float> values) {
    double mean = 0.0;
    for (const float v : values)
        mean += v;
    mean /= static_cast<double>(values.size());
    std::vector<double> out;
    out.reserve(values.size());
    for (const float v : values)
        out.push_back(v - mean);
    return out;
}

double mean_square(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values)
        sum += v * v;
    return sum / static_cast<double>(values.size());
}

double lagged(std::span<const float> amplitudes, PatchSize size, int range_lag, int beam_lag) {
    const std::vector<double> z = centred(amplitudes);
    const double square = mean_square(z);
    const int rows = size.ranges - range_lag;
    const int columns = size.beams - beam_lag;
    if (!(square > 0.0) || rows < 1 || columns < 1) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    const auto width = static_cast<std::size_t>(size.beams);
    const auto down = static_cast<std::size_t>(range_lag);
    const auto right = static_cast<std::size_t>(beam_lag);
    for (std::size_t i = 0; i + down < static_cast<std::size_t>(size.ranges); ++i) {
        for (std::size_t j = 0; j + right < width; ++j)
            sum += z[i * width + j] * z[(i + down) * width + j + right];
    }
    return sum / (static_cast<double>(rows) * columns) / square;
}

}  // namespace

double range_correlation(std::span<const float> amplitudes, PatchSize size, int lag) {
    return lagged(amplitudes, size, lag, 0);
}

double beam_correlation(std::span<const float> amplitudes, PatchSize size, int lag) {
    return lagged(amplitudes, size, 0, lag);
}

double ping_correlation(std::span<const float> one, std::span<const float> other) {
    const std::vector<double> a = centred(one);
    const std::vector<double> b = centred(other);
    const double square = std::sqrt(mean_square(a) * mean_square(b));
    if (!(square > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum / static_cast<double>(a.size()) / square;
}

}  // namespace sonarsim
